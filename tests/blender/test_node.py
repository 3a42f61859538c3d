# SPDX-License-Identifier: GPL-2.0-or-later
"""The node in the built Blender, as an artist meets it: menu, sockets, files, undo, engines."""

from __future__ import annotations

import re
import math
import unittest
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urlparse

import host
import numpy as np
import pixels

# Name, type and default of each input that a model shows, in order. PHYSICAL: with a metal and an
# oxide of the artist's own.
WIRES: tuple[tuple[str, str, Any], ...] = (
    ("Color", "RGBA", [1.0, 1.0, 1.0, 1.0]),
    ("Wire Spacing", "VALUE", 1000.0),
    ("Wire Width", "VALUE", 250.0),
    ("Oxide Thickness", "VALUE", 530.0),
    ("Oxide IOR", "VALUE", 1.544),
    ("Direction", "VALUE", 0.0),
)
FRAME: tuple[tuple[str, str, Any], ...] = (
    ("Normal", "VECTOR", None),
    ("Tangent", "VECTOR", None),
)
INPUTS: dict[str, tuple[tuple[str, str, Any], ...]] = {
    "CS348B": (
        *WIRES,
        ("Diffraction", "VALUE", 0.5),
        ("Specular", "VALUE", 0.3),
        ("Specular Roughness", "VALUE", None),
        ("Diffuse", "VALUE", 0.0),
        ("Lobe Width", "VALUE", None),
        ("Anisotropy", "VALUE", 0.0),
        *FRAME,
    ),
    "PHYSICAL": (
        *WIRES,
        ("Groove Depth", "VALUE", 300.0),
        ("Cross Spacing", "VALUE", 0.0),
        ("Cross Width", "VALUE", 250.0),
        ("Spacing Variation", "VALUE", 0.0),
        ("Coherence Width", "VALUE", 10.0),
        ("Wire Length", "VALUE", 2.0),
        ("Roughness", "VALUE", None),
        ("Metal n", "VECTOR", None),
        ("Metal k", "VECTOR", None),
        *FRAME,
    ),
}
# What a new node has of them.
HIDDEN_AT_FIRST = {"Oxide IOR", "Metal n", "Metal k"}

EFFECTS = ("use_wire_diffraction", "use_grating", "use_thin_film")

# What makes a new node one of a model, with all of the model's inputs.
MODELS: dict[str, dict[str, Any]] = {
    "CS348B": {"model": "CS348B"},
    "PHYSICAL": {"model": "PHYSICAL", "metal": "CUSTOM", "oxide": "CUSTOM"},
}
# And another value of each of its lists.
LISTS = {
    "metal": ("ALUMINIUM", "TUNGSTEN", "SILICON"),
    "oxide": ("SI3N4",),
    "illuminant": ("D65", "A", "F2", "F11", "WHITE_LED", "SODIUM"),
}

# A value of each input that has to look different from the default.
OTHER_VALUES: dict[str, Any] = {
    "Color": [1.0, 0.4, 0.2, 1.0],
    "Wire Spacing": 1300.0,
    "Wire Width": 400.0,
    "Oxide Thickness": 400.0,
    "Oxide IOR": 2.0,
    "Direction": math.radians(60.0),
    "Diffraction": 0.8,
    "Specular": 0.7,
    "Specular Roughness": 0.5,
    "Diffuse": 0.4,
    "Lobe Width": 0.05,
    "Anisotropy": 2.0,
    "Groove Depth": 190.0,
    "Cross Spacing": 1700.0,
    "Cross Width": 600.0,
    "Spacing Variation": 0.08,
    "Coherence Width": 5.0,
    "Wire Length": 12.0,
    "Roughness": 0.25,
    "Metal n": [1.5, 1.2, 0.8],
    "Metal k": [7.0, 6.5, 5.0],
    "Normal": [0.2, 0.1, 0.97],
    "Tangent": [0.6, 0.8, 0.0],
}


class TestCase(unittest.TestCase):
    """Renders end in a folder of the test's own."""

    folder: Path

    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = host.fresh_folder(f"node/{cls.__name__}")

    def inside(self, script: str, parameters: dict[str, Any], **options: Any) -> dict[str, Any]:
        return host.run_inside(
            host.built_blender(), script, parameters, folder=self.folder, seconds=180, **options
        )

    def render(
        self, variants: dict[str, dict[str, Any]], engine: str = "CYCLES", lit: bool = True
    ) -> dict[str, np.ndarray]:
        """The pictures of variants (see inside/render_variants.py), by the variants' names.

        None is negative or without number, and none black where `lit`.
        """
        files = {name: self.folder / f"{engine}.{name}.exr" for name in variants}
        jobs = [variant | {"exr": str(files[name])} for name, variant in variants.items()]
        ended = self.inside("render_variants", {"engine": engine, "variants": jobs}, screen=True)
        self.assertNotRegex(ended["output"], r"(?i)\berror\b", "an error was printed")
        pictures = {name: pixels.read(file) for name, file in files.items()}
        for name, picture in pictures.items():
            self.assertTrue(np.isfinite(picture).all(), name)
            self.assertGreaterEqual(float(picture.min()), 0.0, name)
            if lit:
                self.assertGreater(float(picture.mean()), 1e-3, f"{engine}, {name}: black")
        return pictures


class Facts(TestCase):
    """Names, sockets, menu and help."""

    facts: dict[str, Any]

    @classmethod
    def setUpClass(cls) -> None:
        super().setUpClass()
        cls.facts = host.run_inside(
            host.built_blender(), "node_facts", {}, folder=cls.folder, seconds=60
        )

    def test_name(self) -> None:
        self.assertEqual(self.facts["label"], "IC Wafer BSDF")
        self.assertEqual(self.facts["name"], "IC Wafer BSDF")
        self.assertIn("wafer", self.facts["description"])

    def test_inputs(self) -> None:
        for model, inputs in INPUTS.items():
            found = self.facts["inputs"][model]
            self.assertEqual([(i["name"], i["type"]) for i in found], [i[:2] for i in inputs])
            for socket, (name, _, default) in zip(found, inputs, strict=True):
                if default is not None:
                    np.testing.assert_allclose(socket["default"], default, rtol=1e-6, err_msg=name)

    def test_a_new_node_shows_what_it_needs(self) -> None:
        expected = [name for name, _, _ in INPUTS["PHYSICAL"] if name not in HIDDEN_AT_FIRST]
        self.assertEqual(self.facts["inputs at first"], expected)

    def test_output(self) -> None:
        self.assertEqual(self.facts["outputs"], [["BSDF", "SHADER"]])

    def test_properties(self) -> None:
        properties, values = self.facts["properties"], self.facts["values"]
        self.assertEqual(set(properties), {"model", *LISTS, *EFFECTS})
        first = {"metal": "COPPER", "oxide": "SIO2", "illuminant": "EQUAL_ENERGY"}
        self.assertEqual(
            values, {"model": "PHYSICAL"} | first | dict.fromkeys(EFFECTS, True)
        )
        for name, prop in properties.items():
            self.assertGreater(len(prop["tooltip"]), 20, name)
        for name in ("model", *LISTS):
            for item, tooltip in properties[name]["items"].items():
                self.assertGreater(len(tooltip), 20, item)
        for name, items in LISTS.items():
            self.assertLess(set(items), set(properties[name]["items"]))

    def test_menu(self) -> None:
        self.assertEqual(self.facts["menu"], [["Shader", "IC Wafer BSDF"]])

    def test_help(self) -> None:
        """F1 opens a page about this node, which is part of the installation."""
        page = urlparse(self.facts["help"])
        self.assertEqual(page.scheme, "file", self.facts["help"])
        path = Path(unquote(page.path))
        text = path.read_text()
        for name, _, _ in (*INPUTS["CS348B"], *INPUTS["PHYSICAL"]):
            self.assertIn(name, text)
        pictures = re.findall(r'src="([^"]+)"', text)
        self.assertGreater(len(pictures), 3 * len(INPUTS["PHYSICAL"]))
        for picture in pictures:
            self.assertTrue((path.parent / picture).is_file(), picture)


class Files(TestCase):
    """Nothing of the node is lost in a file."""

    def state(self, blender: Path, **parameters: Any) -> dict[str, Any]:
        given = {"open": None, "save": None, "copy": False} | parameters
        return host.run_inside(blender, "node_file", given, folder=self.folder, seconds=60)

    def test_save_load_copy_and_stock_blender(self) -> None:
        built, stock = host.built_blender(), host.stock_blender()
        ours, theirs = str(self.folder / "ours.blend"), str(self.folder / "theirs.blend")

        saved = self.state(built, save=ours)["state"]
        self.assertEqual(saved["inputs"]["Wire Width"], 0.25, "the test changed nothing")
        self.assertEqual(set(saved["links"]), {"Normal", "Tangent", "Wire Spacing"})
        self.assertEqual(saved["properties"]["use_thin_film"], False)

        with self.subTest("load"):
            self.assertEqual(self.state(built, open=ours)["state"], saved)
        with self.subTest("copy of the material"):
            self.assertEqual(self.state(built, open=ours, copy=True)["state"], saved)
        with self.subTest("stock Blender opens and saves it"):
            there = self.state(stock, open=ours, save=theirs)
            self.assertFalse(there["known"], "the reference knows the node")
            self.assertEqual(there["state"]["inputs"], saved["inputs"])
            self.assertEqual(there["state"]["links"], saved["links"])
        with self.subTest("back from stock Blender"):
            self.assertEqual(self.state(built, open=theirs)["state"], saved)


class Window(TestCase):
    """Work in the shader editor, and what the viewport shows."""

    png: dict[str, Path]
    facts: dict[str, Any]

    @classmethod
    def setUpClass(cls) -> None:
        super().setUpClass()
        cls.png = {shading: cls.folder / f"{shading}.png" for shading in ("SOLID", "MATERIAL")}
        cls.facts = host.run_inside(
            host.built_blender(),
            "window_edit",
            {"png": {shading: str(path) for shading, path in cls.png.items()}},
            folder=cls.folder,
            seconds=120,
            window=True,
        )

    def test_search(self) -> None:
        self.assertEqual(self.facts["search"], ["IC Wafer BSDF"])

    def test_undo(self) -> None:
        first, second = [1000.0, True], [777.0, False]
        self.assertEqual(self.facts["changed"], [first, second])
        self.assertEqual(self.facts["undone"], [first, first])
        self.assertEqual(self.facts["undone twice"], [first])
        self.assertEqual(self.facts["redone"], [first, second])

    def test_copy_and_paste(self) -> None:
        pasted = self.facts["pasted"]
        self.assertEqual(sorted(pasted), sorted(2 * [[1000.0, True], [777.0, False]]))

    def test_viewport(self) -> None:
        """Solid view and material preview show a surface, and no error of OpenGL is printed."""
        self.assertNotRegex(self.facts["output"], r"(?i)shader.*(error|fail)")
        for shading, path in self.png.items():
            with self.subTest(shading):
                middle = pixels.read(path)[32:64, 32:64]
                self.assertGreater(float(middle.mean()), 0.05)
                red, green, blue = middle.mean(axis=(0, 1))
                self.assertFalse(red > 0.9 and green < 0.1 and blue > 0.9, "magenta: no shader")


class Renders(TestCase):
    """What the node renders in each engine."""

    def test_new_node_shows_colours(self) -> None:
        """On a plane under a lamp, with nothing changed: bright and of many hues."""
        picture = self.render({"new": {}})["new"]
        strength = picture.max(axis=2)
        # Not against the maximum: that is the mirror image of the lamp.
        bright = picture[strength > 0.1 * np.percentile(strength, 95)]
        self.assertGreater(len(bright), 0.1 * picture.shape[0] * picture.shape[1])
        strongest = np.bincount(bright.argmax(axis=1), minlength=3) / len(bright)
        for channel, share in zip(("red", "green", "blue"), strongest, strict=True):
            self.assertGreater(share, 0.1, f"hardly anything is mostly {channel}")
        saturation = 1.0 - bright.min(axis=1) / bright.max(axis=1)
        self.assertGreater(float(np.median(saturation)), 0.3)

    def test_every_input_acts_and_links(self) -> None:
        """Another value changes the picture, and the same value through a link does the same."""
        for model in INPUTS:
            self.every_input_acts_and_links(model)

    def every_input_acts_and_links(self, model: str) -> None:
        properties = {"properties": MODELS[model]}
        # Wires of another width need to be there.
        needed = {"Cross Width": {"Cross Spacing": 1700.0}}
        variants: dict[str, dict[str, Any]] = {"default": properties}
        names = [name for name, _, _ in INPUTS[model]]
        for name in names:
            inputs = needed.get(name, {}) | {name: OTHER_VALUES[name]}
            variants[f"{name} linked"] = properties | {"inputs": inputs, "linked": [name]}
            if name not in ("Normal", "Tangent"):
                variants[name] = properties | {"inputs": inputs}
        pictures = self.render(variants)
        default = pictures["default"]
        for name in names:
            with self.subTest(name, model=model):
                linked = pictures[f"{name} linked"]
                change = np.abs(linked - default).mean() / default.mean()
                self.assertGreater(float(change), 0.02, "the picture did not change")
                if name in pictures:
                    np.testing.assert_allclose(linked, pictures[name], rtol=1e-5, atol=1e-6)

    def test_every_effect_acts(self) -> None:
        model = MODELS["CS348B"]
        variants: dict[str, dict[str, Any]] = {"all": {"properties": model}}
        variants |= {effect: {"properties": model | {effect: False}} for effect in EFFECTS}
        pictures = self.render(variants)
        for effect in EFFECTS:
            with self.subTest(effect):
                change = np.abs(pictures[effect] - pictures["all"]).mean() / pictures["all"].mean()
                self.assertGreater(float(change), 0.02, "switching it off changed nothing")

    def test_every_item_of_a_list_acts(self) -> None:
        variants: dict[str, dict[str, Any]] = {"first": {}}
        for name, items in LISTS.items():
            variants |= {item: {"properties": {name: item}} for item in items}
        pictures = self.render(variants)
        for item in variants.keys() - {"first"}:
            with self.subTest(item):
                change = np.abs(pictures[item] - pictures["first"]).mean()
                # Daylight is nearly light of equal energy.
                self.assertGreater(float(change / pictures["first"].mean()), 0.01)

    def test_other_engines(self) -> None:
        """EEVEE and Workbench: a glossy stand-in, with everything linked and nothing linked."""
        variants: dict[str, dict[str, Any]] = {"new": {}}
        for model, inputs in INPUTS.items():
            values = {name: OTHER_VALUES[name] for name, _, _ in inputs}
            variants[model] = {
                "properties": MODELS[model], "inputs": values, "linked": list(values)
            }
        variants["off"] = {"properties": MODELS["CS348B"] | dict.fromkeys(EFFECTS, False)}
        for engine in ("BLENDER_EEVEE", "BLENDER_WORKBENCH"):
            with self.subTest(engine):
                pictures = self.render(variants, engine)
                if engine == "BLENDER_EEVEE":
                    self.assertGreater(float(np.ptp(pictures["new"])), 0.05, "no highlight")


class Extremes(TestCase):
    """Whatever a texture feeds the node, light stays light."""

    SIDE = 64
    ABSURD = (0.0, -1.0, 1e-30, 1e-6, 1.0, 1e9, -1e9, 3e38, math.inf, -math.inf, math.nan)

    def picture(
        self, name: str, model: str, inputs: dict[str, Any], attributes: dict[str, Any]
    ) -> np.ndarray:
        exr = self.folder / f"{model}.{name}.exr"
        given = {
            "side": self.SIDE,
            "properties": MODELS[model],
            "inputs": inputs,
            "attributes": attributes,
            "exr": str(exr),
        }
        self.inside("render_extremes", given)
        return pixels.read(exr)

    def test_absurd_values(self) -> None:
        """Cycles would hide a NaN as black; under a lamp of no size the matt part is always there.

        So each pixel has to be at least as bright as with the matt part alone. Each square has its
        own choice: half of the inputs as they are, half absurd.
        """
        for model in INPUTS:
            with self.subTest(model):
                self.absurd_values(model)

    def absurd_values(self, model: str) -> None:
        generator = np.random.default_rng(348)
        squares = self.SIDE**2
        absurd = {}
        for name, kind, default in INPUTS[model]:
            if kind == "VALUE":
                usual = 0.5 if default is None else default
                choice = generator.choice(self.ABSURD, squares)
                as_it_is = generator.random(squares) < 0.5
                absurd[name] = np.where(as_it_is, usual, choice).tolist()

        alone = self.picture("matt", model, {"Color": [0.0, 0.0, 0.0, 1.0]}, {})
        found = self.picture("absurd", model, {}, absurd)
        self.assertGreater(float(alone.min()), 1e-3)
        self.assertTrue(np.isfinite(found).all())
        dark = np.argwhere((found < 0.999 * alone).any(axis=2))
        # Squares are counted from the bottom of the picture.
        numbers = [(self.SIDE - 1 - row) * self.SIDE + column for row, column in dark]
        first = [{name: values[n] for name, values in absurd.items()} for n in numbers[:3]]
        self.assertEqual(first, [], f"{len(dark)} squares lost light; the first of them")

    def test_absurd_vectors(self) -> None:
        """No tangent, one along the normal, an endless one; and normals that point nowhere."""
        vectors = {
            "none": [0.0, 0.0, 0.0],
            "up": [0.0, 0.0, 1.0],
            "down": [0.0, 0.0, -1.0],
            "flat": [1.0, 0.0, 0.0],
            "huge": [3e38, 3e38, 3e38],
        }

        def variants(socket: str) -> dict[str, dict[str, Any]]:
            return {
                f"{socket} {name}": {
                    "properties": MODELS["CS348B"],
                    "inputs": {"Diffuse": 0.5, socket: vector},
                    "linked": [socket],
                }
                for name, vector in vectors.items()
            }

        def physical(socket: str) -> dict[str, dict[str, Any]]:
            return {
                f"PHYSICAL {name}": variant | {
                    "properties": MODELS["PHYSICAL"],
                    "inputs": {socket: variant["inputs"][socket]},
                }
                for name, variant in variants(socket).items()
            }

        for socket in ("Normal", "Tangent", "Metal n", "Metal k"):
            self.render(physical(socket), lit=False)
        self.render(variants("Normal"), lit=False)
        matt = {
            "properties": MODELS["CS348B"],
            "inputs": {"Diffuse": 0.5, "Diffraction": 0.0, "Specular": 0.0},
        }
        pictures = self.render(variants("Tangent") | {"matt": matt})
        for name in vectors:
            with self.subTest(tangent=name):
                difference = pictures[f"Tangent {name}"] - 0.999 * pictures["matt"]
                self.assertGreaterEqual(float(difference.min()), 0.0)


if __name__ == "__main__":
    unittest.main()
