# SPDX-License-Identifier: MIT
"""picture.py REPORT.html VIEW PICTURE.png [WIDTHxHEIGHT] [SCRIPT]: how a report looks at one of its views, for the gallery.

SCRIPT, where given, is run in the page first: "scenes[0].setColouring(true)"."""
import sys

from browser import Browser

if __name__ == "__main__":
    width, height = map(int, (sys.argv[4] if len(sys.argv) > 4 else "1280x800").split("x"))
    with Browser(width, height) as browser:
        browser.open(sys.argv[1])
        if len(sys.argv) > 5:
            browser.evaluate(sys.argv[5])
        browser.seek(int(sys.argv[2]))
        browser.screenshot(sys.argv[3])
