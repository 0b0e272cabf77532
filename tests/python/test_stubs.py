# SPDX-License-Identifier: Apache-2.0
"""The type stubs name what the module has."""
import ast
import os

import tautline

STUB = os.path.join(os.environ["TAUTLINE_SOURCE_DIR"], "plugin", "python", "tautline", "__init__.pyi")


def list_members(owner):
    return {name for name in dir(owner) if not name.startswith("_")}


def test_stubs_and_module_have_the_same_names():
    with open(STUB) as text:
        tree = ast.parse(text.read())
    stubs = {node.name: node for node in tree.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    assert set(stubs) == list_members(tautline)
    for name, node in stubs.items():
        if not isinstance(node, ast.ClassDef) or name in ("InvalidInput", "ModelError"):
            continue
        declared = {member.name for member in node.body if isinstance(member, ast.FunctionDef)}
        inherited = list_members(tautline.Surface) if name != "Surface" and issubclass(getattr(tautline, name), tautline.Surface) else set()
        assert {member for member in declared if not member.startswith("_")} == list_members(getattr(tautline, name)) - inherited, name


def test_everything_has_a_docstring():
    for name in list_members(tautline):
        thing = getattr(tautline, name)
        assert thing.__doc__, name
        if isinstance(thing, type):
            for member in list_members(thing):
                assert getattr(thing, member).__doc__ is not None or name in ("InvalidInput", "ModelError"), (name, member)
