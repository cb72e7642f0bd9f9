"""test_kubernetes.py: the examples for Kubernetes. The names, types and values of all fields are compared with FIELDS below, which names each field
that the examples may contain; the relations between fields (labels, ports, volumes, completions) are checked here too. The schema that Kubernetes
publishes (the file api/openapi-spec/swagger.json of its repository) is not part of Debian or of this project; LAMBENT_KUBERNETES_SCHEMA names it, and
then it is the reference. The commands run with Swift in the environment of their pods: the variables, another user and a read-only root."""
import copy
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest

try:
    import yaml
except ImportError:
    yaml = None
import store
import test_catalogue

ROOT = pathlib.Path(__file__).resolve().parents[2]
FILES = ("kubernetes-catalogue.yaml", "kubernetes-dask.yaml", "kubernetes-job.yaml")
LONG = os.environ.get("LAMBENT_LONG") == "all"
NAME, TEXT, COUNT, PORT, YES = r"[a-z0-9]([a-z0-9-]*[a-z0-9])?", r"\S.*", int, range(1, 65536), bool
QUANTITY = r"[0-9]+(m|Ki|Mi|Gi)?"
KINDS = {"Job": "batch/v1", "Deployment": "apps/v1", "Service": "v1", "NetworkPolicy": "networking.k8s.io/v1"}
LABELS = {"*": r"[A-Za-z0-9]([A-Za-z0-9._-]*[A-Za-z0-9])?"}
CONTAINER = {
    "name!": NAME, "image!": TEXT, "command": [TEXT], "env": [{"name!": r"[A-Z_]+", "value": TEXT}], "envFrom": [{"secretRef": {"name!": NAME}}],
    "resources": {"requests": {"cpu": QUANTITY, "memory": QUANTITY}, "limits": {"cpu": QUANTITY, "memory": QUANTITY}},
    "securityContext": {"runAsNonRoot": YES, "runAsUser": COUNT, "readOnlyRootFilesystem": YES, "allowPrivilegeEscalation": YES, "capabilities": {"drop": ["ALL"]}},
    "volumeMounts": [{"name!": NAME, "mountPath!": r"/\S*", "readOnly": YES}], "ports": [{"containerPort!": PORT}],
    "readinessProbe": {"tcpSocket": {"port!": PORT}}}
POD = {"metadata": {"labels": LABELS}, "spec!": {
    "restartPolicy": "Never|Always", "containers!": [CONTAINER],
    "volumes": [{"name!": NAME, "emptyDir": {"sizeLimit": QUANTITY}, "persistentVolumeClaim": {"claimName!": NAME, "readOnly": YES}}]}}
SPECS = {  # a name with ! is required; * is any name
    "Job": {"completionMode": "Indexed", "completions": COUNT, "parallelism": COUNT, "backoffLimit": COUNT, "backoffLimitPerIndex": COUNT, "template!": POD,
            "podFailurePolicy": {"rules!": [{"action!": "Ignore|FailJob|Count|FailIndex", "onPodConditions": [{"type!": "DisruptionTarget"}]}]}},
    "Deployment": {"replicas": COUNT, "strategy": {"type": "Recreate|RollingUpdate"}, "selector!": {"matchLabels": LABELS}, "template!": POD},
    "Service": {"selector": LABELS, "ports": [{"port!": PORT, "targetPort": PORT}]},
    "NetworkPolicy": {"podSelector!": {"matchLabels": LABELS}, "policyTypes": ["Ingress|Egress"],
                      "ingress": [{"from": [{"podSelector": {"matchLabels": LABELS}}]}]}}
FIELDS = {kind: {"apiVersion!": version, "kind!": kind, "metadata!": {"name!": NAME}, "spec!": SPECS[kind]} for kind, version in KINDS.items()}


def problems(value, wanted, path=""):
    """Differences between a document and its fields."""
    if isinstance(wanted, dict):
        if not isinstance(value, dict):
            return ["%s: expected fields" % path]
        known = {name.rstrip("!"): found for name, found in wanted.items()}
        found = ["%s.%s: is missing" % (path, name[:-1]) for name in wanted if name.endswith("!") and name[:-1] not in value]
        for name, inner in value.items():
            one = known.get(name, known.get("*"))
            found += problems(inner, one, "%s.%s" % (path, name)) if one is not None else ["%s.%s: is unknown" % (path, name)]
        return found
    if isinstance(wanted, list):
        if not isinstance(value, list) or not value:
            return ["%s: expected a list" % path]
        return [found for index, inner in enumerate(value) for found in problems(inner, wanted[0], "%s[%d]" % (path, index))]
    fits = isinstance(value, str) and re.fullmatch(wanted, value) if isinstance(wanted, str) else type(value) is bool if wanted is bool \
        else type(value) is int and (value >= 0 if wanted is int else value in wanted)
    return [] if fits else ["%s: found %r" % (path, value)]


def schema_problems(value, wanted, definitions, path=""):
    """Differences between a document and a schema of swagger.json; fields that it does not list are differences."""
    if "$ref" in wanted:
        wanted = definitions[wanted["$ref"].rpartition("/")[2]]
    kind = wanted.get("type", "object" if "properties" in wanted else "string")
    if kind == "object" and isinstance(value, dict):
        known, more = wanted.get("properties", {}), wanted.get("additionalProperties")
        found = ["%s.%s: is missing" % (path, name) for name in wanted.get("required", ()) if name not in value]
        for name, inner in value.items():
            one = known.get(name) or more
            found += schema_problems(inner, one, definitions, "%s.%s" % (path, name)) if one else ["%s.%s: is unknown" % (path, name)]
        return found
    if kind == "array" and isinstance(value, list):
        return [found for index, inner in enumerate(value) for found in schema_problems(inner, wanted["items"], definitions, "%s[%d]" % (path, index))]
    types = {"string": (int, str) if wanted.get("format") == "int-or-string" else (str,), "integer": (int,), "boolean": (bool,)}
    fits = type(value) in types.get(kind, ()) and value in wanted.get("enum", [value])
    return [] if fits else ["%s: found %r, expected %s" % (path, value, kind)]


@unittest.skipUnless(yaml, "python3-yaml is not installed")
class Manifests(unittest.TestCase):
    def documents(self):
        for name in FILES:
            for found in yaml.safe_load_all((ROOT / "examples" / name).read_text()):
                yield name, found

    def check(self, found):
        return problems(found, FIELDS.get(found.get("kind"), {}))

    def test_fields_have_known_names_types_and_values(self):
        for name, found in self.documents():
            self.assertEqual(self.check(found), [], name)

    def test_mistakes_are_found(self):
        good = [found for _, found in self.documents() if found["kind"] == "Job"][0]
        for change, sentence in (
                (lambda job: job["spec"].update(completion=3), ".spec.completion: is unknown"), (lambda job: job["spec"].update(completions="3"), "completions: found '3'"),
                (lambda job: job["spec"].pop("template"), ".spec.template: is missing"), (lambda job: job.update(apiVersion="batch/v2"), "apiVersion: found 'batch/v2'"),
                (lambda job: job["spec"]["template"]["spec"]["containers"][0].update(command="lambent"), "command: expected a list"),
                (lambda job: job["spec"]["template"]["spec"]["containers"][0]["resources"]["limits"].update(memory="4GB"), "memory: found '4GB'")):
            job = copy.deepcopy(good)
            change(job)
            self.assertTrue(any(sentence in found for found in self.check(job)), (sentence, self.check(job)))

    def test_the_published_schema(self):
        path = os.environ.get("LAMBENT_KUBERNETES_SCHEMA")
        if not path:
            self.skipTest("LAMBENT_KUBERNETES_SCHEMA does not name swagger.json of Kubernetes")
        definitions = json.loads(pathlib.Path(path).read_text())["definitions"]
        for name, found in self.documents():
            group, _, version = found["apiVersion"].rpartition("/")
            wanted = "io.k8s.api.%s.%s.%s" % ((group or "core").split(".")[0], version, found["kind"])
            self.assertEqual(schema_problems(found, {"$ref": "/" + wanted}, definitions), [], name)
            found["spec"]["nonsense"] = 1
            self.assertEqual(schema_problems(found, {"$ref": "/" + wanted}, definitions), [".spec.nonsense: is unknown"])

    def test_labels_ports_and_volumes_belong_together(self):
        for name in FILES:
            found = [document for file, document in self.documents() if file == name]
            pods = [document["spec"]["template"] for document in found if "template" in document["spec"]]
            labels = [pod.get("metadata", {}).get("labels", {}) for pod in pods]
            for document in found:
                spec = document["spec"]
                selector = spec["selector"] if document["kind"] == "Service" else spec.get("selector", spec.get("podSelector", {})).get("matchLabels", {})
                self.assertTrue(any(selector.items() <= one.items() for one in labels), (name, selector))
                if document["kind"] == "Deployment":
                    self.assertLessEqual(selector.items(), spec["template"]["metadata"]["labels"].items())
                if spec.get("completionMode"):
                    self.assertIn("auto/%d" % spec["completions"], spec["template"]["spec"]["containers"][0]["command"])
            ports = {port["containerPort"] for pod in pods for port in pod["spec"]["containers"][0].get("ports", ())}
            for service in (document for document in found if document["kind"] == "Service"):
                self.assertLessEqual({port["targetPort"] for port in service["spec"]["ports"]}, ports)
                address = "tcp://%s:%d" % (service["metadata"]["name"], service["spec"]["ports"][0]["port"])
                self.assertEqual(sum(address in pod["spec"]["containers"][0]["command"] for pod in pods), 2)
            for pod in pods:
                container = pod["spec"]["containers"][0]
                self.assertEqual({mount["name"] for mount in container.get("volumeMounts", ())}, {volume["name"] for volume in pod["spec"].get("volumes", ())})
                self.assertEqual(bool(pod["spec"].get("restartPolicy")), pod not in [found["spec"]["template"] for found in found if found["kind"] == "Deployment"])


@unittest.skipUnless(yaml and LONG, "python3-yaml is not installed" if not yaml else "in make test-long")
class Pods(test_catalogue.StoreCase):
    """The commands of the examples, each as a pod runs them."""

    def pod(self, document, changes=(), **more):
        """Starts the command of a document's container: only its variables, its user, a read-only root, and an empty folder at /work."""
        container = document["spec"]["template"]["spec"]["containers"][0]
        words = [sys.executable if word == "python3" else word for word in container["command"]]
        for old, new in (("s3://shop/models/", self.models), ("s3://shop/thumbs/{dir}/{stem}.png", self.to), *changes):
            words = [word.replace(old, new) for word in words]
        words = [*([sys.executable, "-m", "lambent.catalogue"] if words[0] == "lambent-catalogue" else words[:1]), *words[1:]]
        variables = {one["name"]: one["value"] for one in container["env"]}
        variables["AWS_ENDPOINT_URL"] = self.env["AWS_ENDPOINT_URL"]
        variables.update({name: store.KEYS[name] for name in ("AWS_ACCESS_KEY_ID", "AWS_SECRET_ACCESS_KEY")}, **more)
        variables.update(PATH=os.environ["PATH"], PYTHONPATH=os.environ["PYTHONPATH"], LAMBENT=test_catalogue.PROGRAM)  # of the image
        context = container["securityContext"]
        self.assertTrue(context["readOnlyRootFilesystem"])
        (mount,) = [one["mountPath"] for one in container["volumeMounts"]]
        script = "mount -t tmpfs -o mode=1777 work /mnt && mount -o remount,bind,ro / && exec \"$@\""
        variables = {name: value if value != mount else "/mnt" for name, value in variables.items()}
        words = ["/mnt" if word == mount else word for word in words]
        user = str(context["runAsUser"])
        return subprocess.Popen(["unshare", "--mount", "sh", "-c", script, "sh", "setpriv", "--reuid", user, "--regid", user, "--clear-groups",
                                 "--no-new-privs", "--bounding-set=-all", "env", "-i", *["%s=%s" % pair for pair in variables.items()], *words],
                                cwd="/", start_new_session=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def documents(self, name):
        return list(yaml.safe_load_all((ROOT / "examples" / name).read_text()))

    def start(self):
        models = test_catalogue.make_models("models", 20)
        (models / "a" / "bad.obj").write_text("v 0 0 0\nf 1 2 3\n")
        self.upload(models)
        (models / "a" / "bad.obj").unlink()
        return self.expected(models, "-s", "256")

    def test_the_indexed_job_draws_each_model_once(self):
        expected, (job,) = self.start(), self.documents("kubernetes-catalogue.yaml")
        for index in range(job["spec"]["completions"]):
            pod = self.pod(job, JOB_COMPLETION_INDEX=str(index))
            text = pod.communicate()[0]
            self.assertEqual(pod.returncode, 0, text)
        self.assertEqual(self.stored(), expected)
        _, lines = self.check_journal({**expected, "a/bad.png": b""}, skip=("a/bad.png",))
        self.assertEqual(sum("output" in line for line in lines), len(expected) + 1)

    def test_the_dask_deployment_draws_all(self):
        if not shutil.which("dask-scheduler"):
            self.skipTest("python3-distributed is not installed")
        expected, (job, scheduler, _, workers, _) = self.start(), self.documents("kubernetes-dask.yaml")
        port, = store.free_ports(1)
        here = (("tcp://lambent-scheduler:8786", "tcp://127.0.0.1:%d" % port), ("8786", str(port)))
        pods = [self.pod(scheduler, here[1:]), *[self.pod(workers, here[:1]) for _ in range(2)]]
        self.addCleanup(lambda: [(os.killpg(pod.pid, signal.SIGKILL), pod.wait(), pod.stdout.close()) for pod in pods])
        time.sleep(1)
        pod = self.pod(job, here[:1])
        text = pod.communicate()[0]
        self.assertEqual(pod.returncode, 0, text)
        self.assertIn("%d of %d pictures written, 1 failed" % (len(expected), len(expected) + 1), text)
        self.assertEqual(self.stored(), expected)


if __name__ == "__main__":
    unittest.main(verbosity=2)
