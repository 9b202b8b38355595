"""What the pages share: words, pictures, and one look for all of them."""

import datetime
import io
import os

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from PIL import Image

plt.rcParams.update({
    "font.size": 13, "axes.titlesize": 13, "legend.fontsize": 11, "figure.dpi": 100, "axes.grid": True, "grid.alpha": 0.3,
    "lines.linewidth": 1.6, "legend.framealpha": 0.8, "savefig.bbox": "tight", "savefig.pad_inches": 0.08,
})


class Page:
    """A page and its pictures."""

    def __init__(self, name, docs):
        self.name = name
        self.docs = docs
        self.text = io.StringIO()

    def write(self, text):
        self.text.write(text.strip("\n") + "\n\n")

    def picture(self, figure, name, caption):
        """Saves a figure of lines with a palette, which makes it small, and shows it."""
        image = self.render(figure)
        self.show(image.quantize(64, dither=Image.Dither.NONE), f"{name}.png", caption, optimize=True)

    def photo(self, figure, name, caption):
        """The same for a figure with pictures in it."""
        self.show(self.render(figure), f"{name}.jpg", caption, quality=60, optimize=True)

    def render(self, figure):
        buffer = io.BytesIO()
        figure.savefig(buffer, format="png")
        plt.close(figure)
        return Image.open(buffer).convert("RGB")

    def show(self, image, name, caption, **options):
        name = f"{self.name}-{name}"
        image.save(os.path.join(self.docs, name), **options)
        self.write(f"![{caption}]({name})")

    def save(self, version, script="scripts/reproduce.sh"):
        self.write(f"---\nMade by `{script}` on {datetime.date.today()} with {version}, {machine()}.")
        with open(os.path.join(self.docs, self.name + ".md"), "w", encoding="utf-8") as file:
            file.write(self.text.getvalue().rstrip("\n") + "\n")


def machine():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        models = [line.split(":", 1)[1].strip() for line in file if line.startswith("model name")]
    return f"on {len(models)} cores of {models[0]}" if models else "on an unnamed machine"


def table(head, rows):
    """A table in Markdown."""
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines)


def show(axes, field, title, low=None, high=None):
    axes.imshow(field, cmap="gray", vmin=low, vmax=high, interpolation="nearest")
    axes.set_title(title)
    axes.set_xticks([])
    axes.set_yticks([])
    axes.grid(False)


def middle_of_spectrum(field, bins, step):
    """The frequencies up to so many bins from 0, which is at the centre, and their extent for imshow."""
    # Rows begin at the top.
    row, column = (field.shape[0] - 1) // 2, field.shape[1] // 2
    part = field[row - bins:row + bins + 1, column - bins:column + bins + 1]
    reach = (bins + 0.5) * step
    return part, (-reach, reach, -reach, reach)
