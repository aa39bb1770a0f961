# SPDX-License-Identifier: BSD-3-Clause
"""`bedscope digitise` as a user meets it: bad input, several pictures, a marker shown, a suggestion.

Usage: command_test.py BEDSCOPE [unittest arguments]. Exit code 77: numpy or Pillow is missing.
"""
import math
import os
import pathlib
import re
import resource
import shutil
import stat
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

try:
    import numpy as np
    from PIL import Image, ImageDraw
except ImportError as missing:
    print(missing)
    sys.exit(77)

PROGRAM = os.path.abspath(sys.argv.pop(1)) if len(sys.argv) > 1 else "bedscope"
FINE = 4  # drawn so much larger, then reduced: anti-aliased
POINTS = [(0.2, 0.3), (0.4, 0.6), (0.5, 0.2), (0.7, 0.8), (0.9, 0.5)]


def place(x, y):
    """Pixel of a point of the test plot: axes 0 to 1 over pixels 60 to 360 and 260 to 20."""
    return 60 + 300 * x, 260 - 240 * y


def draw(path, points=POINTS, colour=(214, 39, 40), bars=None, turn=0.0, curve=()):
    image = Image.new("RGB", (400 * FINE, 300 * FINE), "white")
    pen = ImageDraw.Draw(image)
    corners = [place(0, 0), place(1, 0), place(1, 1), place(0, 1), place(0, 0)]
    pen.line([(FINE * a, FINE * b) for a, b in corners], fill="black", width=FINE)
    for tick in (0.25, 0.5, 0.75):
        a, b = place(tick, 0)
        pen.line([(FINE * a, FINE * b), (FINE * a, FINE * (b + 6))], fill="black", width=FINE)
        a, b = place(0, tick)
        pen.line([(FINE * (a - 6), FINE * b), (FINE * a, FINE * b)], fill="black", width=FINE)
    if curve:
        pen.line([(FINE * a, FINE * b) for a, b in (place(*q) for q in curve)], fill=colour, width=3 * FINE)
    for i, (x, y) in enumerate(points):
        a, b = (FINE * q for q in place(x, y))
        if bars:
            top, bottom = (FINE * place(x, y + s * bars[i])[1] for s in (1, -1))
            pen.line([(a, top), (a, bottom)], fill=colour, width=FINE)
        pen.ellipse([a - 5 * FINE, b - 5 * FINE, a + 5 * FINE, b + 5 * FINE], fill=colour)
    image = image.resize((400, 300), Image.BOX)
    if turn:
        image = image.rotate(turn, resample=Image.BICUBIC, fillcolor="white")
    image.save(path)


X = '[axes.x]\nname = "t"\nunit = "s"\npoints = [{ pixel = [60, 260], value = 0 }, { pixel = [360, 260], value = 1 }]\n'
Y = '[axes.y]\nname = "h"\nunit = "m"\npoints = [{ pixel = [60, 260], value = 0 }, { pixel = [60, 20], value = 1 }]\n'
SERIES = '[[series]]\nname = "a"\nkind = "markers"\ncolour = "#d62728"\n'


class Command(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="bedscope_")
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        draw(self.at("fig.png"))

    def at(self, name):
        return os.path.join(self.folder, name)

    def run_it(self, text, *more, **how):
        with open(self.at("fig.toml"), "w") as file:
            file.write(text)
        return subprocess.run([PROGRAM, "digitise", self.at("fig.toml"), "-o", self.at("out.csv"), *more],
                              capture_output=True, text=True, timeout=120, **how)

    def rows(self, name="out.csv"):
        with open(self.at(name)) as file:
            return [line.rstrip("\n").split(",") for line in file]

    def refuses(self, text, *words):
        run = self.run_it(text)
        self.assertEqual(run.returncode, 2, run.stderr + run.stdout)
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
        for word in words:
            self.assertIn(word, run.stderr)
        self.assertFalse(os.path.exists(self.at("out.csv")))
        self.assertFalse(os.path.exists(self.at("fig.digitised.png")))

    def test_markers_with_units_and_an_overlay(self):
        run = self.run_it('image = "fig.png"\n' + X + Y + SERIES)
        self.assertEqual(run.returncode, 0, run.stderr)
        rows = self.rows()
        self.assertEqual(rows[0], ["series", "t [s]", "t_u [s]", "h [m]", "h_u [m]"])
        self.assertEqual(len(rows), 1 + len(POINTS))
        for row, (x, y) in zip(rows[1:], POINTS):
            self.assertEqual(row[0], "a")
            # Drawn with Pillow, whose ellipses are off by up to a quarter of a pixel.
            self.assertAlmostEqual(float(row[1]), x, delta=0.5 / 300)
            self.assertAlmostEqual(float(row[3]), y, delta=0.5 / 240)
        with Image.open(self.at("fig.digitised.png")) as overlay:
            self.assertEqual(overlay.size, (400, 300))

    def test_error_bars_give_the_values_at_their_ends(self):
        bars = [0.1, 0.15, 0.12, 0.09, 0.2]
        draw(self.at("fig.png"), bars=bars)
        self.assertEqual(self.run_it('image = "fig.png"\n' + X + Y + SERIES).returncode, 0)
        rows = self.rows()
        self.assertEqual(rows[0][5:], ["h_lo [m]", "h_hi [m]"])
        for row, (_, y), bar in zip(rows[1:], POINTS, bars):
            self.assertAlmostEqual(float(row[5]), y - bar, delta=1.0 / 240)
            self.assertAlmostEqual(float(row[6]), y + bar, delta=1.0 / 240)

    def test_log_axis(self):
        axis = Y.replace("value = 0 }", "value = 1 }").replace("[60, 20], value = 1", "[60, 20], value = 100")
        run = self.run_it('image = "fig.png"\n' + X + axis + 'scale = "log"\n' + SERIES)
        self.assertEqual(run.returncode, 0, run.stderr)
        for row, (_, y) in zip(self.rows()[1:], POINTS):
            self.assertAlmostEqual(math.log10(float(row[3])), 2 * y, delta=0.01)
            # Half a pixel of 240 over two decades, at most.
            self.assertLess(float(row[4]) / float(row[3]), 0.02)

    def test_a_curve_of_their_ink_that_nobody_asked_for_does_not_draw_markers_over(self):
        way = [(0.1 * i, 0.3 + 0.4 * math.sin(0.3 * (i - 1))) for i in range(11)]
        points = way[1:-1]
        curve = [(x, y + 0.022 * (-1)**i) for i, (x, y) in enumerate(way)]  # over their upper or lower edges
        draw(self.at("fig.png"), points, curve=curve)
        self.assertEqual(self.run_it('image = "fig.png"\n' + X + Y + SERIES).returncode, 0)
        rows = self.rows()[1:]
        self.assertEqual(len(rows), len(points))
        for row, (x, y) in zip(rows, points):
            self.assertAlmostEqual(float(row[1]), x, delta=0.003)
            self.assertAlmostEqual(float(row[3]), y, delta=0.003)

    def test_a_turned_scan(self):
        draw(self.at("fig.png"), turn=2.0)

        def seen(x, y):
            a, b = place(x, y)
            c, s = math.cos(math.radians(2)), math.sin(math.radians(2))
            return 200 + c * (a - 200) + s * (b - 150), 150 - s * (a - 200) + c * (b - 150)

        def points(*at):
            return ", ".join(f"{{ pixel = [{seen(*p)[0]:.1f}, {seen(*p)[1]:.1f}], value = {v} }}" for p, v in at)

        axes = (f"[axes.x]\npoints = [{points(((0, 0), 0), ((1, 0), 1))}]\n"
                f"[axes.y]\npoints = [{points(((0, 0), 0), ((0, 1), 1))}]\n")
        run = self.run_it('image = "fig.png"\n' + axes + SERIES)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("turned upright by -2.0", run.stdout)
        for row, (x, y) in zip(self.rows()[1:], POINTS):
            self.assertAlmostEqual(float(row[1]), x, delta=0.6 / 300)
            self.assertAlmostEqual(float(row[3]), y, delta=0.6 / 240)

    def test_one_file_for_several_pictures(self):
        draw(self.at("second.png"), points=[(0.3, 0.3), (0.6, 0.4)])
        run = self.run_it('image = ["fig.png", "second.png"]\n' + X + Y + SERIES)
        self.assertEqual(run.returncode, 0, run.stderr)
        folder = self.at("out.csv")  # a folder where there are several pictures
        self.assertEqual(sorted(os.listdir(folder)), ["fig.digitised.csv", "fig.digitised.png",
                                                      "second.digitised.csv", "second.digitised.png"])
        self.assertEqual(len(self.rows("out.csv/second.digitised.csv")), 3)

    def test_a_marker_shown_as_a_template(self):
        a, b = place(*POINTS[0])
        # The reference a pixel to the right of the middle: all points follow.
        shown = f"template = [{a - 8:.0f}, {b - 8:.0f}, 16, 16]\nreference = [{a + 1:.1f}, {b:.1f}]\n"
        run = self.run_it('image = "fig.png"\n' + X + Y + SERIES + shown)
        self.assertEqual(run.returncode, 0, run.stderr)
        rows = self.rows()
        self.assertEqual(len(rows), 1 + len(POINTS))
        for row, (x, _) in zip(rows[1:], POINTS):
            self.assertAlmostEqual(float(row[1]), x + 1 / 300, delta=0.7 / 300)

    def test_excluded_parts_are_not_looked_at(self):
        a, b = place(*POINTS[0])
        run = self.run_it(f'image = "fig.png"\nexclude = [[{a - 10:.0f}, {b - 10:.0f}, 20, 20]]\n' + X + Y + SERIES)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(len(self.rows()), len(POINTS))

    def test_what_is_doubtful_is_said_on_stderr(self):
        run = self.run_it('image = "fig.png"\n' + X + Y + SERIES, "--quiet")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        with Image.open(self.at("fig.png")) as picture:
            framed = picture.convert("RGB")
        for x in range(400):
            for y in range(300):
                if max(framed.getpixel((x, y))) - min(framed.getpixel((x, y))) < 10:
                    framed.putpixel((x, y), (255, 255, 255))
        framed.save(self.at("fig.png"))
        run = self.run_it('image = "fig.png"\n' + X + Y + SERIES, "--quiet")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("doubtful: no frame was found", run.stderr)

    def test_a_marker_of_which_a_part_is_hidden_is_said(self):
        a, b = place(*POINTS[2])
        with Image.open(self.at("fig.png")) as picture:
            image = picture.convert("RGB")
        ImageDraw.Draw(image).rectangle([a + 1, b - 9, a + 2, b + 9], fill="white")
        image.save(self.at("fig.png"))
        run = self.run_it('image = "fig.png"\n' + X + Y + SERIES, "--quiet")
        self.assertEqual(len(self.rows()), len(POINTS))  # with the heading: one is missed
        self.assertIn("1 places look like markers of which a part is hidden: [", run.stderr)

    def test_bars_and_stretches_of_lines_that_are_not_seen_are_said(self):
        draw(self.at("fig.png"), bars=[0.1, 0.15, 0.0, 0.09, 0.2])
        run = self.run_it('image = "fig.png"\n' + X + Y + SERIES, "--quiet")
        a, b = place(*POINTS[2])
        self.assertIn(f"an end of the error bar is not seen at 1 of 5 markers: [{a:.0f}, {b:.0f}]", run.stderr)
        image = Image.open(self.at("fig.png"))
        pen = ImageDraw.Draw(image)
        pen.rectangle([65, 25, 355, 255], fill="white")
        pen.line([80, 200, 340, 90], fill=(214, 39, 40), width=3)
        image.save(self.at("fig.png"))
        text = 'image = "fig.png"\n' + X + Y + SERIES.replace("markers", "line")
        self.assertEqual(self.run_it(text, "--quiet").stderr, "")
        pen.rectangle([190, 60, 230, 220], fill=(31, 119, 180))
        image.save(self.at("fig.png"))
        run = self.run_it(text, "--quiet")
        self.assertEqual((run.returncode, run.stderr.count("\n")), (0, 1), run.stderr)
        self.assertIn("not seen to within a twentieth of an axis at 1 places: [210, ", run.stderr)

    def test_suggestion_shows_area_and_ticks(self):
        run = subprocess.run([PROGRAM, "digitise", "--suggest", self.at("fig.png")], capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn('image = "fig.png"', run.stdout)
        area = next(line for line in run.stdout.splitlines() if line.startswith("plot_area"))
        left, top, width, height = (float(q) for q in area.split("[")[1].rstrip("]").split(","))
        for found, drawn in ((left, 60), (top, 20), (width, 300), (height, 240)):
            self.assertAlmostEqual(found, drawn, delta=2)
        for tick in (0.25, 0.5, 0.75):
            x = place(tick, 0)[0]
            self.assertTrue(any(abs(float(line.split("[")[1].split(",")[0]) - x) < 1 for line in
                                run.stdout.splitlines() if "pixel" in line), f"{tick}: {run.stdout}")

    def test_a_suggestion_with_its_values_filled_in(self):
        run = subprocess.run([PROGRAM, "digitise", "--suggest", self.at("fig.png")], capture_output=True, text=True)
        head, x_axis, rest = re.split(r"\[axes\..\]\n", run.stdout)
        y_axis = rest.split("[[series]]")[0]

        def filled(axis, value_of):
            return re.sub(r"\[([\d.]+), ([\d.]+)\], value = nan",
                          lambda m: f"[{m[1]}, {m[2]}], value = {value_of(float(m[1]), float(m[2]))}", axis)

        x_axis = filled(x_axis, lambda a, b: round(4 * (a - 60) / 300) / 4)
        y_axis = filled(y_axis, lambda a, b: round(4 * (260 - b) / 240) / 4)
        run = self.run_it(f"{head}[axes.x]\n{x_axis}[axes.y]\n{y_axis}{SERIES}")
        self.assertEqual(run.returncode, 0, run.stderr)
        rows = self.rows()
        self.assertEqual(len(rows), 1 + len(POINTS))
        for row, (x, y) in zip(rows[1:], POINTS):
            self.assertAlmostEqual(float(row[1]), x, delta=0.75 / 300)
            self.assertAlmostEqual(float(row[3]), y, delta=0.75 / 240)
            # Of the ticks' rounding to whole pixels, which five of them do not show in their scatter, and of the
            # marker's half of a half pixel: without the former it would be 0.27 px.
            self.assertGreater(float(row[2]), math.hypot(0.25, 0.25) / 300)

    def test_the_documentation_lists_the_shapes(self):
        run = self.run_it('image = "fig.png"\n' + X + Y + SERIES + 'shape = "heart"\n')
        names = run.stderr.split("one of ")[1].split(", found")[0].split(", ")
        self.assertGreater(len(names), 10)
        text = (pathlib.Path(__file__).parents[3] / "docs" / "digitiser.md").read_text()
        for name in names:
            self.assertIn(f"`{name}`", text)

    def test_a_jpeg_is_read_as_viewers_show_it(self):
        with Image.open(self.at("fig.png")) as picture:
            upright = picture.convert("RGB")
        exif = Image.Exif()
        exif[0x0112] = 6  # to be turned clockwise by a right angle
        upright.rotate(90, expand=True).save(self.at("fig.jpg"), quality=95, exif=exif.tobytes())
        run = self.run_it('image = "fig.jpg"\n' + X + Y + SERIES)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("EXIF orientation", run.stdout)
        rows = self.rows()
        self.assertEqual(len(rows), 1 + len(POINTS))
        for row, (x, y) in zip(rows[1:], POINTS):
            self.assertAlmostEqual(float(row[1]), x, delta=0.5 / 300)
            self.assertAlmostEqual(float(row[3]), y, delta=0.5 / 240)
        upright.save(self.at("fig.jpg"), quality=95, exif=Image.Exif().tobytes())
        run = self.run_it('image = "fig.jpg"\n' + X + Y + SERIES)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertNotIn("EXIF", run.stdout)

    def test_a_frame_around_the_axis_points_is_found(self):
        def axis(name, ends):
            points = ", ".join(f"{{ pixel = [{a:.0f}, {b:.0f}], value = {v} }}" for (a, b), v in ends)
            return f"[axes.{name}]\npoints = [{points}]\n"

        axes = (axis("x", [(place(0.1, 0.1), 0.1), (place(0.9, 0.1), 0.9)])
                + axis("y", [(place(0.1, 0.1), 0.1), (place(0.1, 0.9), 0.9)]))
        run = self.run_it('image = "fig.png"\n' + axes + SERIES)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertEqual(len(self.rows()), 1 + len(POINTS))

    def test_inputs_are_not_written_over(self):
        text = 'image = "fig.png"\n' + X + Y + SERIES
        with open(self.at("fig.toml"), "w") as file:
            file.write(text)
        shutil.copy(self.at("fig.png"), self.at("fig.digitised.png"))
        os.symlink("fig.png", self.at("link.png"))

        def files():
            return {path.name: path.read_bytes() for path in pathlib.Path(self.folder).iterdir()}

        before = files()
        for words in (["fig.toml", "-o", "fig.png"], ["fig.toml", "-o", "./fig.toml"], ["fig.toml", "-o", "link.png"],
                      ["fig.toml", "-o", "fig.digitised.png"], ["--suggest", "fig.png", "-o", "fig.png"],
                      ["fig.toml", "--image", "fig.png", "--image", "fig.digitised.png"]):
            run = subprocess.run([PROGRAM, "digitise", *words], capture_output=True, text=True, cwd=self.folder)
            self.assertEqual((run.returncode, run.stderr.count("\n")), (2, 1), (words, run.stderr))
            self.assertIn(words[-1].removeprefix("./"), run.stderr)
            self.assertTrue(files() == before, words)

    def test_pixels_outside_the_picture_are_refused(self):
        head, size = 'image = "fig.png"\n', "400 x 300"
        self.refuses(head + X.replace("[360, 260]", "[3600, 260]") + Y + SERIES, "fig.png", "axes.x", size,
                     "[3600, 260]")
        self.refuses(head + X + Y.replace("[60, 20]", "[60, -20]") + SERIES, "fig.png", "axes.y", "[60, -20]")
        self.refuses(head + "plot_area = [60, 20, 3000, 240]\n" + X + Y + SERIES, "plot_area", size, "3000")
        self.refuses(head + "exclude = [[500, 20, 30, 240]]\n" + X + Y + SERIES, "exclude", size, "500")
        box = "template = [395, 100, 16, 16]\n"
        self.refuses(head + X + Y + SERIES + box, '"a"', "template", size, "[395, 100, 16, 16]")
        box = "template = [112, 180, 16, 16]\nreference = [1120, 188]\n"
        self.refuses(head + X + Y + SERIES + box, '"a"', "reference", size, "[1120, 188]")
        # One that goes to the edge and beyond says what is meant.
        run = self.run_it(head + "exclude = [[380, -50, 900, 900]]\n" + X + Y + SERIES)
        self.assertEqual(run.returncode, 0, run.stderr)

    def test_bad_files_end_in_one_line(self):
        head = 'image = "fig.png"\n'
        self.refuses(head + X + Y + SERIES.replace("d62728", "2ca02c"), "fig.png", '"a"', "#2ca02c", "found none")
        # All that is missing at once: a colour that is not there, and markers where there is a curve.
        with Image.open(self.at("fig.png")) as picture:
            curve = picture.convert("RGB")
        ImageDraw.Draw(curve).line([80, 240, 350, 170], fill=(44, 160, 44), width=2)
        curve.save(self.at("curve.png"))
        others = "".join(SERIES.replace('"a"', f'"{name}"').replace("d62728", colour)
                         for name, colour in (("b", "9467bd"), ("c", "2ca02c"), ("d", "1f77b4")))
        self.refuses('image = "curve.png"\n' + X + Y + others + SERIES, '"b": expected pixels of colour #9467bd',
                     '"c": expected markers of colour #2ca02c', '"d": expected pixels of colour #1f77b4')
        self.refuses(head + X.replace("[360, 260]", "[60, 260]") + Y + SERIES, "axes.x", "singular")
        self.refuses(head + X.replace("value = 1", "value = 0") + Y + SERIES, "axes.x", "singular")
        self.refuses(head + X + 'scale = "log"\n' + Y + SERIES, "above 0 on a log axis")
        self.refuses(head + X + 'scale = "cubic"\n' + Y + SERIES, "line 6", '"cubic"')
        self.refuses(head + X + Y + SERIES + 'shape = "heart"\n', "series.shape", '"heart"')
        self.refuses(head + X + Y + SERIES.replace('"markers"', '"bars"'), "series.kind", '"bars"')
        self.refuses(head + X + Y + SERIES + "color = 1\n", "series.color", "series.colour")
        self.refuses(head + X + Y + SERIES.replace("#d62728", "#d6272"), "series.colour", "#d6272")
        self.refuses(head + X + SERIES, "axes.y is missing")
        self.refuses(head + X + Y, "no [[series]]")
        self.refuses('image = "none.png"\n' + X + Y + SERIES, "none.png")
        self.refuses(head + "plot_area = [900, 900, 50, 50]\n" + X + Y + SERIES, "plot_area")
        three = X.replace("}]", "}, { pixel = [210, 260], value = 0.8 }]")
        self.refuses(head + three + Y + SERIES, "axes.x", "linear scale")

    def test_bad_pictures_end_in_one_line(self):
        text = 'image = "bad.png"\n' + X + Y + SERIES
        with open(self.at("fig.png"), "rb") as file:
            whole = file.read()

        def bad(content, *words):
            with open(self.at("bad.png"), "wb") as file:
                file.write(content)
            self.refuses(text, "bad.png", *words)

        bad(b"", "PNG or JPEG")
        bad(b"GIF89a", "PNG or JPEG")
        bad(whole[:20], "end of the file")
        bad(whole[:len(whole) // 2], "end")
        header = struct.pack(">IIBBBBB", 60000, 60000, 8, 2, 0, 0, 0)
        chunk = struct.pack(">I", 13) + b"IHDR" + header + struct.pack(">I", zlib.crc32(b"IHDR" + header))
        bad(whole[:8] + chunk + whole[33:], "60000 x 60000")
        header = struct.pack(">IIBBBBB", 8000, 8000, 8, 2, 0, 0, 0)
        chunk = struct.pack(">I", 13) + b"IHDR" + header + struct.pack(">I", zlib.crc32(b"IHDR" + header))
        bad(whole[:8] + chunk + whole[33:60] + b"IEND", "cannot hold")
        bad(whole[:60] + bytes(200) + whole[260:], "damaged")

    def test_a_write_that_fails_leaves_all_files_as_they_were(self):
        draw(self.at("second.png"), points=[(0.3, 0.3), (0.6, 0.4)])
        text = 'image = ["fig.png", "second.png"]\n' + X + Y + SERIES
        self.assertEqual(self.run_it(text).returncode, 0)

        def files():
            return {path.name: path.read_bytes() for path in pathlib.Path(self.at("out.csv")).iterdir()}

        before = files()
        for size in [0, *(len(content) - 1 for content in before.values())]:
            run = self.run_it(text.replace('name = "a"', 'name = "b"'),
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size)))
            self.assertEqual((run.returncode, run.stderr.count("\n")), (2, 1), run.stderr)
            self.assertTrue(files() == before, size)

    def test_folders_pipes_and_devices_are_not_replaced(self):
        text = 'image = "fig.png"\n' + X + Y + SERIES
        os.mkdir(self.at("fig.digitised.png"))
        run = self.run_it(text)
        self.assertEqual((run.returncode, run.stderr.count("\n")), (2, 1), run.stderr)
        self.assertFalse(os.path.exists(self.at("out.csv")))
        os.rmdir(self.at("fig.digitised.png"))
        os.mkfifo(self.at("out.csv"))
        run = self.run_it(text)
        self.assertEqual((run.returncode, run.stderr.count("\n")), (2, 1), run.stderr)
        self.assertTrue(stat.S_ISFIFO(os.stat(self.at("out.csv")).st_mode))
        self.assertFalse(os.path.exists(self.at("fig.digitised.png")))

    def test_same_result_every_time(self):
        text = 'image = "fig.png"\n' + X + Y + SERIES
        self.run_it(text)
        with open(self.at("out.csv"), "rb") as file:
            first = file.read()
        self.run_it(text, "--threads", "1")
        with open(self.at("out.csv"), "rb") as file:
            self.assertEqual(file.read(), first)


if __name__ == "__main__":
    unittest.main()
