# SPDX-License-Identifier: MIT
"""report_page_test.py PROGRAM: runs of the program as pages, looked at in a headless browser.

Exit codes: 0 all is well, 1 something is not, 77 there is no browser here."""
import base64
import json
import math
import os
import statistics
import struct
import subprocess
import sys
import tempfile
import zlib

from browser import Browser, find

# Pixels of a PNG that is decoded by the browser itself: how many colours, and how many pixels differ from the last one.
LOOK = """async (data) => {
  const image = await createImageBitmap(await (await fetch("data:image/png;base64," + data)).blob());
  const canvas = new OffscreenCanvas(image.width, image.height);
  const context = canvas.getContext("2d");
  context.drawImage(image, 0, 0);
  const stage = document.getElementById("stage").getBoundingClientRect();
  const pixels = new Uint32Array(context.getImageData(stage.x, stage.y, stage.width, stage.height).data.buffer);
  const last = window.lastPixels;
  window.lastPixels = pixels;
  return { colours: new Set(pixels).size,
           changed: last ? pixels.reduce((sum, pixel, i) => sum + (pixel === last[i] ? 0 : 1), 0) : -1 };
}"""

checks = 0


def check(holds, what):
    global checks
    checks += 1
    if not holds:
        raise AssertionError(what)


def write_depth(path, width, height, millimetres):
    """A depth image of one distance, as PNG of 16 bits."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = (b"\0" + struct.pack(">H", millimetres) * width) * height
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 16, 0, 0, 0, 0)) +
                   chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def write_recording(folder, frames):
    """A depth camera that goes along a wall 2 m away, laid out as 7-Scenes is."""
    os.mkdir(folder)
    with open(os.path.join(folder, "camera-intrinsics.txt"), "w", encoding="utf-8") as file:
        file.write("55 0 32\n0 55 24\n0 0 1\n")
    for i in range(frames):
        name = os.path.join(folder, f"frame-{i:06}.")
        write_depth(name + "depth.png", 64, 48, 2000)
        with open(name + "pose.txt", "w", encoding="utf-8") as file:
            file.write(f"1 0 0 {0.3 * i + 0.05 * i * i}\n0 1 0 0\n0 0 1 0\n0 0 0 1\n")


def run(program, *arguments):
    ended = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, check=False)
    check(ended.returncode in (0, 3, 4), f"{arguments}: {ended.stderr}")


def value_at(report, key):
    for part in key.split("."):
        report = report[part]
    return report


def look(browser):
    data = base64.b64encode(browser.screenshot()).decode()
    return browser.evaluate(f"({LOOK})('{data}')")


def drawn(browser):
    browser.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))")


def look_by_hand(browser):
    """Orbit, pan and zoom, by mouse and by touch."""
    def after(what, action):
        state = "[scenes[0].camera.position.toArray(), scenes[0].controls.target.toArray()]"
        before = browser.evaluate(state)
        action()
        drawn(browser)
        now = browser.evaluate(state)
        check(now != before, f"{what} does nothing")
        return [math.dist(*before), math.dist(*now)], before[1] == now[1]

    def drag(button):
        for kind, x in (("mousePressed", 500), ("mouseMoved", 600), ("mouseReleased", 600)):
            browser.call("Input.dispatchMouseEvent", type=kind, x=x, y=400, button=button, clickCount=1)

    def touch(*moments):
        for kind, fingers in (("touchStart", moments[0]), ("touchMove", moments[1]), ("touchEnd", [])):
            browser.call("Input.dispatchTouchEvent", type=kind,
                         touchPoints=[{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(fingers)])

    (before, now), same_target = after("a drag", lambda: drag("left"))
    check(abs(now - before) < 1e-3 * before and same_target, "a drag turns the view about its middle")
    check(not after("a drag with the right button", lambda: drag("right"))[1], "it moves the middle")
    (before, now), _ = after("the wheel", lambda: browser.call(
        "Input.dispatchMouseEvent", type="mouseWheel", x=500, y=400, deltaX=0, deltaY=-240))
    check(now < before, "the wheel does not come closer")
    browser.call("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=2)
    after("one finger", lambda: touch([(450, 400)], [(550, 430)]))
    (before, now), _ = after("two fingers", lambda: touch([(450, 400), (500, 400)], [(400, 400), (560, 400)]))
    check(now < before, "fingers that part do not come closer")
    browser.call("Emulation.setTouchEmulationEnabled", enabled=False)


def look_at_the_curves(browser, report):
    """Over views, metres and seconds; a click in them moves the slider; the time of a cycle by its stages."""
    ways = set()
    for value in ("view", "metres", "seconds"):
        browser.evaluate(f"document.querySelector('#abscissa button[value={value}]').click()")
        pressed = browser.evaluate("[...document.querySelectorAll('#abscissa [aria-pressed=true]')].map((b) => b.value)")
        check(pressed == [value], pressed)
        ways.add(browser.evaluate("document.querySelector('#frontier .curve').getAttribute('d')"))
    check(len(ways) == 3 or report["planner"] == "next-best-view", "the axis of the curves does not change")
    browser.evaluate("document.querySelector('#abscissa button[value=view]').click()")
    box = browser.evaluate("""(() => { const box = document.getElementById("times").getBoundingClientRect();
        return [box.x, box.y, box.width, box.height]; })()""")
    for share in (0.95, 0.3):
        x, y = box[0] + 52 + share * (box[2] - 62), box[1] + box[3] / 2
        for kind in ("mousePressed", "mouseReleased"):
            browser.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)
        wanted = round(0.5 + share * report["views"])
        now = browser.evaluate("[state.now, +document.getElementById('slider').value]")
        check(abs(now[0] - wanted) <= 1 and now[0] == now[1], f"a click at {share} leads to {now}, not {wanted}")
    stages = browser.evaluate("document.getElementById('times-key').textContent")
    check("insert" in stages and "survey" in stages, f"the stages of a cycle are {stages}")


def look_at_what_is_known(browser, report):
    """Where no truth is there to measure by, the curve is what is known, as the record tells it."""
    cells = [frame["free_cells"] + frame["occupied_cells"] for frame in report["replay"]["frames"]]
    check(browser.evaluate("runs[0].replay.known_cells") == cells, "known cells are not those of the replay")
    check(browser.evaluate("document.getElementById('coverage-title').textContent").startswith("Known"), "its title")
    check(browser.evaluate("document.querySelectorAll('#coverage .curve').length") == 1, "it has no curve")


def look_at_the_layers(browser, folder, layers):
    """What a run has to show is there, in the legend, and in its colour; other colours and slices look different."""
    browser.open(os.path.join(folder, "report.html"))
    named = browser.evaluate("[...document.querySelectorAll('#layers input[type=checkbox]')].map((e) => e.name)")
    check(set(layers) <= set(named), f"the legend has {named}")
    shown = 0
    for view in range(1, browser.evaluate("runs[0].report.views") + 1):
        browser.seek(view)
        if "candidates" in layers and browser.evaluate("scenes[0].candidates.count") > 1:
            colours = browser.evaluate("""(() => { const column = scenes[0].candidates.geometry.attributes.colour.array;
                return new Set(Array.from({ length: column.length / 3 }, (_, i) =>
                    column.slice(3 * i, 3 * i + 3).join())).size; })()""")
            shown += colours > 1
    check(shown > 0 or "candidates" not in layers, "candidate views are nowhere coloured by their utility")
    if "voids" in layers:
        check(browser.evaluate("runs[0].replay.voids.counts.some((n) => n > 0)"), "there are no voids")
        swatches = browser.evaluate("[...document.querySelectorAll('#layers .swatch')].map((e) => e.style.background)")
        check("rgb(167, 139, 250)" in swatches, f"voids are not violet: {swatches}")
    if "field" in layers:
        browser.seek(5)
        look(browser)
        moved = browser.evaluate("""(() => { const all = [...document.querySelectorAll("#layers input[type=range]")];
            const slider = all.find((e) => e.getAttribute("aria-label") === "field at");
            slider.dispatchEvent(new Event("pointerdown"));
            const share = (slider.value - slider.min) / (slider.max - slider.min);
            slider.value = +slider.min + (share < 0.5 ? 0.75 : 0.25) * (slider.max - slider.min);
            slider.dispatchEvent(new Event("input"));
            return scenes[0].slice; })()""")
        drawn(browser)
        check(look(browser)["changed"] > 200, f"the field looks the same at {moved} m")
    look(browser)
    browser.evaluate("""(() => { const select = document.querySelector("#layers select"); select.value = "time";
        select.dispatchEvent(new Event("change")); })()""")
    drawn(browser)
    check(look(browser)["changed"] > 1000, "surfaces by the first view look as by height")
    check(not browser.errors, browser.errors)


def look_at_one_run(browser, folder):
    """Loads without complaint, tells the numbers of report.json, and shows another picture at other views."""
    with open(os.path.join(folder, "report.json"), encoding="utf-8") as file:
        report = json.load(file)
    page = os.path.join(folder, "report.html")
    check(os.path.getsize(page) < 20e6, "the page is too large")
    with open(page, encoding="utf-8") as file:
        text = file.read()
    check("http-equiv" not in text and ' src="' not in text and "@import" not in text, "the page asks for more files")
    check("Permission is hereby granted" in text, "the licence of three.js goes along")
    browser.open(page)
    shown = browser.evaluate("""Object.fromEntries([...document.querySelectorAll("#numbers dd")]
        .map((e) => [e.dataset.key, [JSON.parse(e.dataset.value), e.textContent]]))""")
    for key in ("outcome", "views", "path_length_m", "coverage", "collisions", "time_ms.plan.median", "seed"):
        value = value_at(report, key)
        check(shown[key][0] == value if value is not None else key not in shown, f"{key} is {shown.get(key)}")
    if report["coverage"] is not None:
        check(shown["coverage"][1] == f"{100 * report['coverage']:.2f} %", shown["coverage"])
    check(shown["path_length_m"][1] == f"{report['path_length_m']:.1f} m", shown["path_length_m"])
    cycles = browser.evaluate("runs[0].report.cycles")
    check(cycles == report["cycles"], "the cycles of the page are not those of report.json")

    views = report["views"]
    for view in (1, (views + 1) // 2, views):
        browser.seek(view)
        cycle = report["cycles"][view - 1]
        moment = browser.evaluate("document.getElementById('moment').value")
        check(f"view {view} of {views}" in moment and f"{cycle['path_length_m']:.1f} m" in moment, moment)
        seen = look(browser)
        check(seen["colours"] > 100, f"view {view} is blank: {seen}")
        check(seen["changed"] == -1 or seen["changed"] > 1000, f"view {view} looks like the one before: {seen}")
    look_by_hand(browser)
    look_at_the_curves(browser, report)
    browser.seek(views)
    browser.evaluate("document.getElementById('play').click()")
    check(browser.evaluate("state.playing && state.now === 1"), "play starts the run again")
    for _ in range(100):
        if browser.evaluate("new Promise((done) => setTimeout(() => done(state.now), 100))") > 1:
            break
    check(browser.evaluate("state.now") > 1, "playing does not go on by itself")
    browser.evaluate("document.getElementById('play').click()")
    for name in browser.evaluate("[...document.querySelectorAll('#layers input[type=checkbox]')].map((e) => e.name)"):
        browser.evaluate(f"document.querySelector('#layers input[name={name}]').click()")
    browser.seek(views)
    check(look(browser)["changed"] > 1000, "nothing changes when all layers are switched off")
    check(not browser.errors, browser.errors)


def look_at_a_comparison(browser, folder, reports):
    """Every run has its curve and its scene; medians are those of the reports."""
    browser.open(os.path.join(folder, "report.html"))
    check(browser.evaluate("scenes.length") == len(reports), "not every run is replayed")
    check(browser.evaluate("document.querySelectorAll('#coverage .curve').length") == len(reports), "curves are missing")
    rows = browser.evaluate("""[...document.querySelectorAll('#table tbody tr')].map((row) =>
        Object.fromEntries([...row.cells].map((cell) => [cell.dataset.column, cell.dataset.value])))""")
    check(len(rows) == 2, f"there are {len(rows)} groups of runs, not 2")
    for column, key in (("views", "views"), ("path [m]", "path_length_m"), ("turned [°]", "turned_deg"),
                        ("coverage", "coverage")):
        groups = {}
        for report in reports:
            groups.setdefault(report["planner"], []).append(report[key])
        medians = sorted(statistics.median(values) for values in groups.values())
        shown = sorted(float(row[column]) for row in rows)
        check(all(abs(a - b) < 1e-9 for a, b in zip(medians, shown)), f"{column}: {shown}, not {medians}")
    browser.seek(1)
    look(browser)
    browser.seek(12)
    check(look(browser)["changed"] > 1000, "the runs do not move")
    check(not browser.errors, browser.errors)


def main(program):
    if not find():
        print("Skipped: there is no Chromium here to look at a report with")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        rooms = os.path.join(folder, "rooms")
        run(program, "explore", "--world", "rooms", "--planner", "harmonic", "--out", rooms)
        table = os.path.join(folder, "table")
        run(program, "explore", "--world", "table", "--planner", "frontier-gain", "--sensor", "kinect",
            "--max-views", 12, "--out", table)
        recording = os.path.join(folder, "recording")
        write_recording(recording, 6)
        replay = os.path.join(folder, "replay")
        run(program, "replay", "--dataset", recording, "--format", "7scenes", "--resolution", 0.1, "--planner",
            "frontier-void,harmonic", "--out", replay)
        voids = os.path.join(folder, "voids")
        run(program, "explore", "--world", "table", "--planner", "frontier-void", "--sensor", "kinect", "--resolution",
            0.1, "--max-views", 6, "--seed", 2, "--out", voids)
        for one in (rooms, table, replay):
            with Browser() as browser:
                look_at_one_run(browser, one)
                if one == replay:
                    with open(os.path.join(one, "report.json"), encoding="utf-8") as file:
                        look_at_what_is_known(browser, json.load(file))
        for one, layers in ((rooms, ["surfaces", "frontiers", "path", "plan", "sensor", "field"]),
                            (table, ["candidates"]), (voids, ["voids"])):
            with Browser() as browser:
                look_at_the_layers(browser, one, layers)
        again = os.path.join(folder, "again")
        run(program, "explore", "--world", "table", "--planner", "frontier-gain", "--sensor", "kinect", "--seed", 2,
            "--max-views", 8, "--out", again, "--quiet")
        files = [os.path.join(one, "report.json") for one in (rooms, table, again)]
        both = os.path.join(folder, "both")
        run(program, "compare", *files, "--out", both)
        reports = []
        for name in files:
            with open(name, encoding="utf-8") as file:
                reports.append(json.load(file))
        with Browser() as browser:
            look_at_a_comparison(browser, both, reports)
    print(f"{checks} checks passed")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
