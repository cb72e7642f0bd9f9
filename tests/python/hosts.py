"""hosts.py: hosts of a small network on this machine, each a network namespace behind a bridge. Needs root and Debian's iproute2."""
import os
import shutil
import subprocess


def why_not():
    """Why there are no hosts here, or None."""
    if not shutil.which("ip") or os.geteuid():
        return "network namespaces need root and iproute2"
    name = "lam%d" % os.getpid()
    if subprocess.run(["ip", "netns", "add", name], stderr=subprocess.DEVNULL).returncode:
        return "no network namespaces"
    subprocess.run(["ip", "netns", "del", name], check=True)
    return None


class Hosts:
    """`address` is that of this machine in the network; `command` starts a command on a host."""

    def __init__(self, count):
        self.bridge, net = "lam%d" % os.getpid(), "198.18.%d." % (os.getpid() % 250)  # addresses for tests of networks
        self.names, self.address = ["%s-%d" % (self.bridge, index) for index in range(count)], net + "1"
        self.ip("link add %s type bridge" % self.bridge, "address add %s/24 dev %s" % (self.address, self.bridge), "link set %s up" % self.bridge)
        for index, name in enumerate(self.names):
            self.ip("netns add " + name, "link add %s type veth peer name eth0 netns %s" % (name, name), "link set %s master %s up" % (name, self.bridge),
                    "-n %s address add %s%d/24 dev eth0" % (name, net, index + 2), "-n %s link set eth0 up" % name, "-n %s link set lo up" % name)

    def ip(self, *commands):
        for command in commands:
            subprocess.run(["ip", *command.split()], check=True)

    def command(self, index, *words):
        return ["ip", "netns", "exec", self.names[index], *words]

    def cut(self, index):
        """Takes a host's cable away."""
        self.ip("link set %s down" % self.names[index])

    def stop(self):
        for name in self.names:
            self.ip("netns del " + name)
        self.ip("link del " + self.bridge)
