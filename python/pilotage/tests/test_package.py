"""The package as a whole: its types, its documentation, its notebook, the global lock."""

import ast
import inspect
import threading
import time
from importlib import metadata, resources
from pathlib import Path

import notebook
import numpy as np
import pilotage
import pytest
from pilotage import _native

EXAMPLES = Path(__file__).parent.parent / "examples"


def stubs():
    text = resources.files(pilotage).joinpath("_native.pyi").read_text(encoding="utf-8")
    return ast.parse(text)


def parameters(function):
    given = function.args
    names = [a.arg for a in given.posonlyargs + given.args + given.kwonlyargs]
    names += [given.kwarg.arg] if given.kwarg else []
    return [name for name in names if name not in ("self", "cls")]


def test_the_types_tell_of_everything_that_is_there_and_of_nothing_else():
    assert resources.files(pilotage).joinpath("py.typed").is_file()
    told = {node.name: node for node in stubs().body if isinstance(node, ast.ClassDef | ast.FunctionDef)}
    there = {name for name in dir(_native) if not name.startswith("_")}
    assert set(told) == there
    assert there <= set(pilotage.__all__)
    for name, node in told.items():
        thing = getattr(_native, name)
        if isinstance(node, ast.FunctionDef):
            assert parameters(node) == list(inspect.signature(thing).parameters), name
            continue
        members = {n.name: n for n in node.body if isinstance(n, ast.FunctionDef)}
        own = {n for n, v in vars(thing).items() if not n.startswith("_")}
        own |= {n for n in ("__getitem__", "__len__", "__contains__", "__new__") if n in members}
        assert set(members) == own, name
        for member, function in members.items():
            is_property = any(getattr(d, "id", "") == "property" for d in function.decorator_list)
            value = inspect.getattr_static(thing, member)
            assert is_property == inspect.isdatadescriptor(value), (name, member)
            if not is_property and not member.startswith("__"):
                signature = list(inspect.signature(value).parameters)
                assert parameters(function) == [p for p in signature if p != "self"], (name, member)


def test_everything_public_has_a_docstring():
    for name in pilotage.__all__:
        thing = getattr(pilotage, name)
        if name == "__version__":
            continue
        assert thing.__doc__, name
        if isinstance(thing, type):
            members = [n for n in vars(thing) if not n.startswith("_")]
            lacking = [n for n in members if not inspect.getattr_static(thing, n).__doc__]
            assert not lacking, (name, lacking)


def test_the_version_is_that_of_the_program():
    assert pilotage.__version__.count(".") == 2
    try:
        installed = metadata.version("pilotage")
    except metadata.PackageNotFoundError:
        pytest.skip("the package is not installed but beside its build")
    assert installed == pilotage.__version__


def test_other_threads_go_on_while_the_library_works():
    picture = np.random.default_rng(1).normal(size=(1500, 1500)).astype(np.float32)
    patch = picture[300:420, 500:620].copy()
    span = []

    def work():
        span.append(time.perf_counter())
        pilotage.correlate(picture, patch)
        span.append(time.perf_counter())

    worker = threading.Thread(target=work)
    worker.start()
    moments = []
    while worker.is_alive():
        moments.append(time.perf_counter())
        time.sleep(0)
    # With the lock held this thread would stand still from the beginning of the call to its end.
    begun, ended = span
    quarter = (ended - begun) / 4
    assert any(begun + quarter < moment < ended - quarter for moment in moments), len(moments)


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("*.ipynb")), ids=lambda path: path.stem)
def test_a_notebook_prints_what_is_stored_in_it(path, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for cell, stored, printed in notebook.outputs(path):
        assert printed == stored, f"cell {cell}"
