# SPDX-License-Identifier: MIT
"""evaluation_page_test.py PROGRAM [PICTURE.png]: the page of an evaluation, looked at in a headless browser.

Exit codes: 0 all is well, 1 something is not, 77 there is no browser here."""
import json
import os
import subprocess
import sys
import tempfile

from browser import Browser, find


def check(holds, what):
    if not holds:
        raise AssertionError(what)


def main(program, picture=None):
    if not find():
        print("no Chromium here: the page of an evaluation is not tested")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "evaluate", "exploration", "--worlds", "small-maze", "--planners",
                        "next-best-view,frontier-gain,hypotheses=30", "--quick", "--out", folder],
                       check=True, stdout=subprocess.DEVNULL)
        page = os.path.join(folder, "index.html")
        with open(page, encoding="utf-8") as file:
            text = file.read()
        check("http-equiv" not in text and ' src="' not in text and "@import" not in text, "the page asks for more files")
        with open(os.path.join(folder, "results.json"), encoding="utf-8") as file:
            results = json.load(file)
        with Browser(1400, 900) as browser:
            browser.open(page)
            cells = browser.evaluate("""[...document.querySelectorAll("tbody tr")].map((row) => Object.fromEntries(
                [...row.querySelectorAll("[data-column]")].map((cell) => [cell.dataset.column, cell.textContent])))""")
            check(len(cells) == len(results["rows"]) == 2, f"{len(cells)} rows")
            for cell, row in zip(cells, results["rows"]):
                for column in results["columns"]:
                    spread = row[column["key"]]
                    if spread is None:
                        check(cell.get(column["key"], "–") == "–", column)
                    elif spread["median"] is not None:
                        text = f"{spread['median']:.{column['digits']}f}"
                        shown = cell[column["key"]]
                        # The browser rounds halves away from zero, Python to even.
                        near = abs(float(shown[:len(text)]) - spread["median"]) <= 0.51 * 10.0 ** -column["digits"]
                        check(shown.startswith(text) or near, f"{column['key']} is {shown}, not {text}")
            curves = "document.querySelectorAll('.plot .curve').length"
            check(browser.evaluate(curves) == 2 * 2 + 2, "a curve of each run and a median of each planner")
            way = "document.querySelector('.plot .median').getAttribute('d')"
            seconds = browser.evaluate(way)
            browser.evaluate("document.querySelector('#abscissa button[value=metres]').click()")
            check(browser.evaluate(way) != seconds, "metres change no curve")
            browser.evaluate("document.querySelector('#planners input').click()")
            check(browser.evaluate(curves) == 3, "a planner that is hidden keeps its curves")
            check(browser.evaluate("document.querySelector('tbody tr').hidden"), "its row stays")
            browser.evaluate("document.querySelector('#planners input').click()")
            colours = browser.evaluate("new Set([...document.querySelectorAll('.plot .median')]"
                                       ".map((curve) => curve.getAttribute('stroke'))).size")
            check(colours == 2, "two planners have one colour")
            browser.screenshot(picture)
            check(not browser.errors, browser.errors)
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
