"""Runs the cells of a notebook in this interpreter, without a kernel, and knows what they print.

`python notebook.py FILE.ipynb` stores what the cells print now.
"""

import ast
import contextlib
import io
import json
import sys


def shown(value):
    """Output of a cell whose last line is an expression."""
    return {
        "output_type": "execute_result",
        "metadata": {},
        "data": {"text/plain": repr(value).splitlines(keepends=True)},
    }


def run(source, names):
    """Outputs of a cell as a notebook stores them."""
    body = ast.parse(source)
    last = body.body.pop() if body.body and isinstance(body.body[-1], ast.Expr) else None
    outputs, value, said = [], None, io.StringIO()
    with contextlib.redirect_stdout(said):
        exec(compile(body, "<cell>", "exec"), names)
        if last is not None:
            value = eval(compile(ast.Expression(last.value), "<cell>", "eval"), names)
    if said.getvalue():
        text = said.getvalue().splitlines(keepends=True)
        outputs.append({"output_type": "stream", "name": "stdout", "text": text})
    if value is not None:
        outputs.append(shown(value))
    return outputs


def outputs(path):
    """(number of a cell, its stored outputs, its outputs now), cell by cell."""
    names = {"__name__": "__main__"}
    book = json.loads(path.read_text(encoding="utf-8"))
    for number, cell in enumerate(book["cells"]):
        if cell["cell_type"] != "code":
            continue
        stored = [
            {key: value for key, value in output.items() if key != "execution_count"}
            for output in cell["outputs"]
        ]
        yield number, stored, run("".join(cell["source"]), names)


def store(path):
    """Writes the notebook with its outputs as they are now."""
    book = json.loads(path.read_text(encoding="utf-8"))
    for count, (number, _, now) in enumerate(outputs(path), 1):
        cell = book["cells"][number]
        cell["execution_count"] = count
        counted = [o | {"execution_count": count} if "data" in o else o for o in now]
        cell["outputs"] = counted
    text = json.dumps(book, indent=1, ensure_ascii=False) + "\n"
    path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    from pathlib import Path

    store(Path(sys.argv[1]).resolve())
