# SPDX-License-Identifier: MIT
"""strip.py REPORT.html VIEW,VIEW,... PICTURE.png [X,Y,Z [DISTANCE_M [AZIMUTH_DEG,ELEVATION_DEG]]]: how a model grows.

The surfaces after each of these views, side by side, with what the last scan added in a warmer tone. They are looked at
from so far off (1.5 m) in that direction (-120,25), the middle of the picture being at X,Y,Z (0,0,0.6)."""
import math
import sys

from browser import Browser

SIDE, ROW = 250, 5


def aim(browser, middle, distance, azimuth, elevation):
    level = distance * math.cos(elevation)
    place = (middle[0] + level * math.cos(azimuth), middle[1] + level * math.sin(azimuth),
             middle[2] + distance * math.sin(elevation))
    browser.evaluate(f"""(() => {{
        const scene = scenes[0];
        for (const name of Object.keys(scene.layers)) scene.setShown(name, name === "surfaces");
        scene.reserved = () => 0;
        scene.controls.enableDamping = false;
        scene.controls.minDistance = 0;
        scene.controls.target.set({", ".join(map(str, middle))});
        scene.camera.position.set({", ".join(map(str, place))});
        scene.camera.near = 0.05;
        scene.controls.update();
        scene.resize();
    }})()""")


def picture_after(browser, view):
    browser.seek(view)
    return browser.evaluate("""(() => { scenes[0].dirty = true; scenes[0].draw();
        return [document.querySelector("canvas").toDataURL("image/png"), document.getElementById("moment").value]; })()""")


def figure(picture, caption):
    return (f'<figure style="margin:4px"><img src="{picture}" style="width:{SIDE}px;height:{SIDE}px;object-fit:cover">'
            f'<figcaption style="text-align:center;padding:2px">{caption}</figcaption></figure>')


if __name__ == "__main__":
    views = [int(view) for view in sys.argv[2].split(",")]
    numbers = [[float(number) for number in text.split(",")] for text in sys.argv[4:]]
    middle, (distance,), angles = (numbers + [[0.0, 0.0, 0.6], [1.5], [-120.0, 25.0]][len(numbers):])
    width, height = min(len(views), ROW) * (SIDE + 8) + 8, math.ceil(len(views) / ROW) * (SIDE + 34) + 8
    with Browser() as browser:
        browser.open(sys.argv[1])
        aim(browser, middle, distance, *map(math.radians, angles))
        figures = "".join(figure(*picture_after(browser, view)) for view in views)
        browser.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        browser.call("Page.navigate", url="about:blank")
        browser.evaluate(f"""document.body.style =
            "margin:4px;display:flex;flex-wrap:wrap;background:#10151c;color:#c8d2de;font:14px sans-serif";
            document.body.innerHTML = `{figures}`;
            Promise.all([...document.images].map((image) => image.decode()))""")
        browser.screenshot(sys.argv[3])
