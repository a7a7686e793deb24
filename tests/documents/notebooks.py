"""The notebooks of docs/notebooks, run: `python -m documents.notebooks` runs them and writes their outputs.

`make notebooks` does that. The outputs that are kept are small and the same everywhere: no times of execution, no
addresses, pictures in 64 colours.
"""

import io
import re
import sys
from base64 import b64decode, b64encode
from pathlib import Path

import nbformat
from nbclient import NotebookClient
from PIL import Image

FOLDER = Path(__file__).parents[2] / "docs" / "notebooks"
LIMIT_S = 300
KEPT = ("image/png", "text/html", "text/plain")


def paths():
    """The notebooks, in order."""
    return sorted(FOLDER.glob("*.ipynb"))


def executed(path):
    """A notebook after all its cells have run in a fresh kernel; an error in a cell is raised."""
    notebook = nbformat.read(path, as_version=4)
    client = NotebookClient(
        notebook,
        timeout=LIMIT_S,
        kernel_name="python3",
        resources={"metadata": {"path": str(path.parent)}},
    )
    client.extra_arguments = ["--log-level=ERROR"]
    client.execute()
    return cleaned(notebook)


def cleaned(notebook):
    """The notebook without what differs from run to run."""
    notebook.metadata = nbformat.from_dict(
        {
            "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
            "language_info": {"name": "python"},
        }
    )
    for number, cell in enumerate(notebook.cells, 1):
        # The site takes the description of a picture from here.
        kept = {name: value for name, value in cell.metadata.items() if name == "mystnb"}
        cell.id, cell.metadata = f"cell-{number}", nbformat.from_dict(kept)
        if cell.cell_type == "code":
            cell.outputs = [cleaned_output(output) for output in merged(cell.outputs)]
    return notebook


def merged(outputs):
    """Outputs with successive pieces of one stream in one; what is printed as errors is left out."""
    kept = []
    for output in outputs:
        if output.output_type == "stream" and kept and kept[-1].output_type == "stream":
            kept[-1].text += output.text
        elif output.get("name") != "stderr":
            kept.append(output)
    return kept


def cleaned_output(output):
    """An output with the kinds of data that are kept; a picture has no other text than that it is one."""
    if "data" not in output:
        return output
    data = {kind: output.data[kind] for kind in KEPT if kind in output.data}
    if "image/png" in data:
        data = {"image/png": small(data["image/png"]), "text/plain": "<Figure>"}
    if "text/html" in data:
        data["text/html"] = re.sub(r"<style.*?</style>\s*", "", data["text/html"], flags=re.DOTALL)
    output.data, output.metadata = nbformat.from_dict(data), nbformat.from_dict({})
    return output


def small(png):
    """A picture in 64 colours, in base 64."""
    written = io.BytesIO()
    image = Image.open(io.BytesIO(b64decode(png))).convert("RGB")
    image.quantize(64, dither=Image.Dither.NONE).save(written, "PNG", optimize=True)
    return b64encode(written.getvalue()).decode() + "\n"


def texts(notebook):
    """What each cell shows, as texts; pictures by their size."""
    return [[shown(output) for output in cell.outputs] for cell in notebook.cells if cell.cell_type == "code"]


def shown(output):
    """The text of an output, or the size of its picture."""
    if output.output_type == "stream":
        return output.text
    if "image/png" in output.data:
        return f"a picture of {Image.open(io.BytesIO(b64decode(output.data['image/png']))).size}"
    return output.data["text/plain"]


def main(names):
    for path in paths():
        if not names or path.stem in names:
            nbformat.write(executed(path), path)
            print(f"{path.name}: {path.stat().st_size / 1000:.0f} kB")


if __name__ == "__main__":
    main(sys.argv[1:])
