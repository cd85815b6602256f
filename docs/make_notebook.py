"""Runs the notebooks of docs and writes their outputs into them: python docs/make_notebook.py.

A cell shows what it prints, and the figure that its last line names.
"""

from __future__ import annotations

import ast
import base64
import contextlib
import io
import json
from pathlib import Path
from typing import Any

NOTEBOOKS = sorted(Path(__file__).parent.glob("learn/*.ipynb"))


def run(source: str, names: dict[str, Any]) -> tuple[str, Any]:
    """Runs a cell; what it prints, and the value of its last line."""
    tree, value = ast.parse(source), None
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    with contextlib.redirect_stdout(io.StringIO()) as out:
        exec(compile(tree, "cell", "exec"), names)
        if isinstance(last, ast.Expr):
            value = eval(compile(ast.Expression(last.value), "cell", "eval"), names)
    return out.getvalue(), value


def picture(figure: Any) -> str:
    """A figure of matplotlib as base64."""
    data = io.BytesIO()
    figure.savefig(data, format="png", dpi=80)
    return base64.b64encode(data.getvalue()).decode() + "\n"


def outputs(source: str, names: dict[str, Any], number: int) -> list[dict[str, Any]]:
    """The outputs of a cell, as the format of notebooks has them."""
    printed, value = run(source, names)
    lines = printed.splitlines(keepends=True)
    found: list[dict[str, Any]] = []
    if lines:
        found.append({"name": "stdout", "output_type": "stream", "text": lines})
    if hasattr(value, "savefig"):
        data = {"image/png": picture(value), "text/plain": ["a figure"]}
        kind = {"output_type": "execute_result", "execution_count": number, "metadata": {}}
        found.append({"data": data, **kind})
    return found


def main() -> None:
    """Runs every notebook."""
    import matplotlib

    matplotlib.use("agg")
    for path in NOTEBOOKS:
        notebook, names, number = json.loads(path.read_text(encoding="utf-8")), {}, 0
        for cell in notebook["cells"]:
            if cell["cell_type"] == "code":
                number += 1
                cell["execution_count"] = number
                cell["outputs"] = outputs("".join(cell["source"]), names, number)
        text = json.dumps(notebook, indent=1, ensure_ascii=False)
        path.write_text(f"{text}\n", encoding="utf-8")


if __name__ == "__main__":
    main()
