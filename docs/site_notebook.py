"""A hook of MkDocs: each notebook of docs is a page too, with the outputs that it holds."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from mkdocs.config.defaults import MkDocsConfig
    from mkdocs.structure.files import Files


def text_of(output: dict[str, Any]) -> str:
    """One output of a cell: printed text, or a picture."""
    data = output.get("data", {})
    if "image/png" in data:
        return f"![what the cell draws](data:image/png;base64,{data['image/png'].strip()})\n"
    printed = "".join(output.get("text", data.get("text/plain", [])))
    return f"```text\n{printed.rstrip()}\n```\n"


def page_of(notebook: dict[str, Any]) -> str:
    """The page of a notebook: its words, its code and what that printed."""
    parts = []
    for cell in notebook["cells"]:
        source = "".join(cell["source"])
        if cell["cell_type"] == "markdown":
            parts.append(f"{source}\n")
            continue
        parts.append(f"```python\n{source}\n```\n")
        parts += [text_of(output) for output in cell["outputs"]]
    return "\n".join(parts)


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Adds the page of each notebook beside it."""
    from mkdocs.structure.files import File

    for file in [file for file in files if file.src_uri.endswith(".ipynb")]:
        notebook = json.loads(Path(str(file.abs_src_path)).read_text(encoding="utf-8"))
        uri = f"{file.src_uri.removesuffix('.ipynb')}.md"
        files.append(File.generated(config, uri, content=page_of(notebook)))
    return files
