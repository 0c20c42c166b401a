# SPDX-License-Identifier: MIT
"""report_page_test.py PROGRAM: runs of the program as pages, looked at in a headless browser.

Exit codes: 0 all is well, 1 something is not, 77 there is no browser here."""
import base64
import json
import os
import statistics
import subprocess
import sys
import tempfile

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


def run(program, *arguments):
    ended = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, check=False)
    check(ended.returncode in (0, 3), f"{arguments}: {ended.stderr}")


def value_at(report, key):
    for part in key.split("."):
        report = report[part]
    return report


def look(browser):
    data = base64.b64encode(browser.screenshot()).decode()
    return browser.evaluate(f"({LOOK})('{data}')")


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
        check(shown[key][0] == value_at(report, key), f"{key} is {shown.get(key)}")
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
    before = browser.evaluate("scenes[0].camera.position.toArray()")
    for kind, x in (("mousePressed", 500), ("mouseMoved", 600), ("mouseReleased", 600)):
        browser.call("Input.dispatchMouseEvent", type=kind, x=x, y=400, button="left", clickCount=1)
    browser.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
    check(browser.evaluate("scenes[0].camera.position.toArray()") != before, "a drag does not turn the view")
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
    for column, key in (("views", "views"), ("path [m]", "path_length_m"), ("coverage", "coverage")):
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
        for one in (rooms, table):
            with Browser() as browser:
                look_at_one_run(browser, one)
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
