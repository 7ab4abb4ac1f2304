"""The stubs say what there is: names of functions, methods and parameters, and the package is marked as typed."""

import ast
import inspect
from importlib import resources

import cutaway
from cutaway import _native


def declared(text):
    """Functions by their names, and their parameters; methods as ``Scene.cut``."""
    found = {}
    for node in ast.parse(text).body:
        members = node.body if isinstance(node, ast.ClassDef) and not node.name.startswith("_") else []
        for member in [node, *members]:
            if isinstance(member, ast.FunctionDef):
                prefix = f"{node.name}." if member is not node else ""
                found[prefix + member.name] = [a.arg for a in member.args.args if a.arg != "self"]
    return found


def differences(text):
    found = []
    stubs = declared(text)
    there = {name for name in dir(_native) if callable(getattr(_native, name)) and not name.startswith("__")}
    there |= {f"Scene.{name}" for name in dir(_native.Scene) if not name.startswith("__")}
    names = {name for name in stubs if not name.endswith("__init__")} | {"Scene"}
    found += sorted(there ^ names)
    for name, parameters in stubs.items():
        if name.endswith("__init__") or name not in there:
            continue
        function = _native
        for word in name.split("."):
            function = getattr(function, word)
        own = [p for p in inspect.signature(function).parameters if p != "self"]
        if own != parameters:
            found.append(f"{name}: {own}, not {parameters}")
    return found


def test_stubs_are_those_of_the_module():
    text = resources.files(cutaway).joinpath("_native.pyi").read_text()
    assert differences(text) == []
    assert differences(text.replace("def remove(", "def take_away("))
    assert differences(text.replace("relief_cells: int", "cells: int"))


def test_the_package_is_typed_and_documented():
    assert resources.files(cutaway).joinpath("py.typed").is_file()
    for name in cutaway.__all__:
        thing = getattr(cutaway, name)
        if name == "__version__":
            continue
        assert inspect.getdoc(thing), name
        if inspect.isclass(thing) and thing.__module__.startswith("cutaway"):
            for method, function in vars(thing).items():
                if inspect.isfunction(function) and not method.startswith("_"):
                    assert function.__doc__, f"{name}.{method}"
