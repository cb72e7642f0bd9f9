"""demands.py: the forms that a contract may demand, and contracts that demand all of them, to test that mistakes in them are found."""
import json
import subprocess

# Texts that are mistakes only if a contract demands the other form.
DEMANDED = {"no-gate": "gate", "normal-unit-late": "unit_normals", "ambient-attenuated": "bare_ambient"}
# The built-in contracts that do not demand all of them.
LENIENT = ("learnopengl-pbr", "learnopengl", "threejs", "nyu")


def demanding(program, shader, ids, folder):
    """The options for checking a shader of classroom/tests/check with the mistakes `ids`, with a contract that demands the other forms."""
    name = next((n for n in LENIENT if shader.startswith(n)), None)
    if not name or not DEMANDED.keys() & set(ids):
        return ()
    path = folder / f"demanding-{name}.json"
    if not path.exists():
        text = subprocess.run([program, "generate", f"contract-{name}"], stdout=subprocess.PIPE, check=True).stdout
        path.write_text(json.dumps({**json.loads(text), **{key: "required" for key in DEMANDED.values()}}))
    return ("--contract", str(path))
