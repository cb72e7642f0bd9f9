"""setup.py: builds the package `lambent` (docs/python.md). LAMBENT_BUILD is a build folder of Meson. Its library becomes part of the extension, and
the required libraries and the module for Draco are stored next to it, with their licences, and the wheel's tag names the C library that they need.
Without LAMBENT_BUILD, the extension uses the installed liblambent (pkg-config)."""
import os
import pathlib
import platform
import re
import shlex
import shutil
import subprocess
import sys

from setuptools import setup
from setuptools.command.build_ext import build_ext
from wheel.bdist_wheel import bdist_wheel

ROOT = pathlib.Path(__file__).resolve().parent.parent
os.chdir(ROOT / "python")
os.umask(0o022)
sys.path[:0] = [str(ROOT / "python"), str(ROOT / "scripts")]
import project  # noqa: E402

INSIDE = {"spng": "libspng0", "jansson": "libjansson4", "jpeg": "libjpeg62-turbo"}  # a library, and the Debian package that contains its licence
DRACO = ROOT / "src/formats/import/gltf/draco/draco_module.cpp"


class Build(build_ext):
    def build_extension(self, extension):
        build = os.environ.get("LAMBENT_BUILD")
        if build:
            extension.extra_objects = [str(pathlib.Path(build, "src/liblambent.a").resolve())]
            extension.depends = extension.extra_objects
            extension.libraries = [*INSIDE, "z", "m", "pthread", "dl"]
            extension.extra_link_args = ["-s", "-Wl,--disable-new-dtags,-rpath,$ORIGIN/libs"]
        else:
            extension.extra_link_args = shlex.split(subprocess.check_output(["pkg-config", "--libs", "lambent"], text=True))
        extension.extra_compile_args = ["-ffile-prefix-map=%s=." % ROOT]
        super().build_extension(extension)

    def run(self):
        import describe
        super().run()
        folder = pathlib.Path(self.build_lib, "lambent")
        describe.write_members(folder / "_members.py")
        if os.environ.get("LAMBENT_BUILD"):
            self.add_libraries(folder / "libs")
            self.add_draco(folder)
        shutil.copy(ROOT / "LICENSE", folder)
        describe.write_stubs(folder)
        for path in folder.rglob("*"):  # the modes of copied files depend on who unpacked the sources
            path.chmod(0o755 if path.is_dir() or path.stat().st_mode & 0o100 else 0o644)

    def add_libraries(self, folder):
        """Copies the libraries that the extension loads, under the names by which it loads them, and their licences."""
        folder.mkdir(parents=True, exist_ok=True)
        linked = subprocess.check_output(["ldd", self.get_ext_fullpath("lambent._native")], text=True)
        for library, package in INSIDE.items():
            name, path = re.search(r"(lib%s\.so\S*) => (\S+)" % library, linked).groups()
            if pathlib.Path(path).resolve().parent != folder.resolve():
                shutil.copy(path, folder / name)
            shutil.copy("/usr/share/doc/%s/copyright" % package, folder / (package + ".copyright"))

    def add_draco(self, folder):
        """The module that the library opens for Draco, which contains Debian's archive of Draco."""
        command = [*shlex.split(os.environ.get("CXX", "g++")), "-std=c++17", "-O2", "-DNDEBUG", "-shared", "-fPIC", "-fvisibility=hidden", "-s",
                   "-Wl,--gc-sections,--exclude-libs,ALL", "-ffile-prefix-map=%s=." % ROOT, DRACO, "-o", folder / "lambent-draco.so", "-l:libdraco.a"]
        subprocess.run(command, check=True)
        shutil.copy("/usr/share/doc/libdraco-dev/copyright", folder / "libs/libdraco-dev.copyright")


class Wheel(bdist_wheel):
    """The wheel's tag is the newest version of the C library that a symbol of its files needs, at least 2.17, as manylinux has it."""

    def get_tag(self):
        python, abi, tag = super().get_tag()
        if os.environ.get("LAMBENT_BUILD"):
            files = [str(path) for path in pathlib.Path(self.bdist_dir).rglob("*.so*")]
            symbols = subprocess.check_output(["objdump", "-T", *files], text=True)
            tag = "manylinux_2_%d_%s" % (max(17, *(int(minor) for minor in re.findall(r"GLIBC_2\.(\d+)", symbols))), platform.machine())
        return python, abi, tag


setup(version=project.version(), cffi_modules=["binding.py:builder"],
      cmdclass={"build_ext": Build, "bdist_wheel": Wheel}, options={"bdist_wheel": {"py_limited_api": "cp311"}})
