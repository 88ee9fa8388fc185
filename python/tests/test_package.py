# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the pcl_flashreg authors

"""What is installed: what the module links, and that its stubs are true."""

import ast
import inspect
import pathlib
import re
import shutil
import subprocess

import pytest

import pcl_flashreg
from pcl_flashreg import _core

FOLDER = pathlib.Path(pcl_flashreg.__file__).parent


def test_no_pcl_is_needed():
    if not shutil.which("readelf"):
        pytest.skip("no readelf")
    command = ["readelf", "--dynamic", _core.__file__]
    output = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout
    needed = re.findall(r"NEEDED.*\[(.*)\]", output)
    assert any(name.startswith("libstdc++") for name in needed)
    allowed = r"lib(stdc\+\+|m|gcc_s|c|pthread|dl|rt|pcl_flashreg_core)\.so|ld-linux"
    assert [name for name in needed if not re.match(allowed, name)] == []


def test_version():
    assert re.fullmatch(r"\d+\.\d+\.\d+", pcl_flashreg.__version__)


STUBS = ast.parse((FOLDER / "__init__.pyi").read_text())


def stubs_of(tree, kind):
    return {node.name: node for node in tree.body if isinstance(node, kind)}


CLASSES = stubs_of(STUBS, ast.ClassDef)
PUBLIC_CLASSES = {name: c for name, c in CLASSES.items() if not name.startswith("_")}
FUNCTIONS = stubs_of(STUBS, ast.FunctionDef)


def test_typed():
    assert (FOLDER / "py.typed").exists()


def test_stubs_have_all_there_is():
    assert sorted([*PUBLIC_CLASSES, *FUNCTIONS]) == sorted(pcl_flashreg.__all__)


def names_in(node):
    fields = [n.target.id for n in node.body if isinstance(n, ast.AnnAssign)]
    return fields + list(stubs_of(node, ast.FunctionDef))


@pytest.mark.parametrize("name", PUBLIC_CLASSES)
def test_stubs_of_members(name):
    there = getattr(pcl_flashreg, name)
    members = {m for m in vars(there) if not m.startswith("_")}
    stubs = {m for m in names_in(PUBLIC_CLASSES[name]) if not m.startswith("_")}
    assert members == stubs
    if "__init__" not in names_in(PUBLIC_CLASSES[name]) and name != "BackendError":
        with pytest.raises(TypeError):
            there()
    if "__len__" in names_in(PUBLIC_CLASSES[name]):
        assert hasattr(there, "__len__")


def arguments_in(signature):
    """The names of arguments in what pybind11 writes, and their defaults."""
    inside = signature[signature.index("(") + 1 : signature.rindex(") ->")]
    parts = re.split(r", (?=\*|\w+:)", inside)
    found = {}
    for part in parts:
        name, _, rest = part.partition(":")
        if name not in ("", "self", "*"):
            found[name] = rest.partition(" = ")[2]
    return found


def arguments_of(node):
    """The same in a stub."""
    defaults = [None] * len(node.args.args) + list(node.args.defaults)
    defaults = defaults[-len(node.args.args) :] if node.args.args else []
    pairs = list(zip(node.args.args, defaults))
    pairs += list(zip(node.args.kwonlyargs, node.args.kw_defaults))
    return {
        a.arg: ast.unparse(d) if d is not None else ""
        for a, d in pairs
        if a.arg not in ("self", "cls")
    }


COMPILED = [(None, f) for f in FUNCTIONS if f not in ("align", "estimate_pose")] + [
    (name, f)
    for name, node in PUBLIC_CLASSES.items()
    for f, stub in stubs_of(node, ast.FunctionDef).items()
    if name != "Parameters"
    and f != "__len__"
    and not any(ast.unparse(d) == "property" for d in stub.decorator_list)
]


@pytest.mark.parametrize(("owner", "name"), COMPILED)
def test_stubs_of_compiled_functions(owner, name):
    scope = getattr(pcl_flashreg, owner) if owner else pcl_flashreg
    stubs = stubs_of(CLASSES[owner], ast.FunctionDef) if owner else FUNCTIONS
    signature = getattr(scope, name).__doc__.partition("\n")[0]
    assert arguments_in(signature) == arguments_of(stubs[name])


@pytest.mark.parametrize("name", ["align", "estimate_pose"])
def test_stubs_of_functions_that_pass_on(name):
    method = stubs_of(CLASSES["PairRegistration"], ast.FunctionDef)[name]
    passed = arguments_of(method)
    own = {
        p.name: repr(p.default)
        for p in inspect.signature(getattr(pcl_flashreg, name)).parameters.values()
        if p.kind == p.KEYWORD_ONLY
    }
    assert arguments_of(FUNCTIONS[name]) == {**passed, **own}


def test_stubs_of_parameters():
    import dataclasses

    fields = {f.name for f in dataclasses.fields(pcl_flashreg.Parameters)}
    node = CLASSES["Parameters"]
    assert set(arguments_of(stubs_of(node, ast.FunctionDef)["__init__"])) == fields
    assert fields | {"__init__", "from_resolution"} == set(names_in(node))


@pytest.mark.parametrize("name", pcl_flashreg.__all__)
def test_everything_is_explained(name):
    thing = getattr(pcl_flashreg, name)
    assert thing.__module__ in ("pcl_flashreg", "pcl_flashreg._core")
    if name == "BackendError":
        return
    assert len(thing.__doc__.replace(name, "")) > 10
    for member, value in vars(thing).items() if isinstance(thing, type) else ():
        plain = name in ("Evidence", "Parameters") or member.startswith("_")
        assert plain or value.__doc__, f"{name}.{member}"


def test_help_of_align_is_that_of_the_method():
    text = pcl_flashreg.align.__doc__
    assert text.startswith("Registers two clouds") and "num_threads" in text
