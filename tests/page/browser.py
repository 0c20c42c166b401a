# SPDX-License-Identifier: MIT
"""A headless Chromium, driven over a pipe by its DevTools protocol. Needs nothing but Python and Chromium."""
import base64
import json
import os
import select
import shutil
import subprocess
import tempfile
import time

NAMES = ("chromium", "chromium-browser", "google-chrome")


def find():
    """The program to run, or None where there is none."""
    return next((path for path in map(shutil.which, NAMES) if path), None)


class Browser:
    """One page of 1280 x 800 pixels; `errors` is what it complained about."""

    def __init__(self, width=1280, height=800):
        self.errors = []
        self._events = []
        self._number = 0
        self._buffer = b""
        self._session = None
        self._profile = tempfile.mkdtemp(prefix="vantage-page-")
        to_read, self._to = os.pipe()
        self._from, to_write = os.pipe()

        def at_3_and_4():
            # Away from 3 and 4 first, should either lie there.
            a, b = os.dup(to_read), os.dup(to_write)
            os.dup2(a, 3)
            os.dup2(b, 4)

        command = [find(), "--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--use-gl=angle",
                   "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--hide-scrollbars",
                   "--remote-debugging-pipe", "--no-first-run", "--disable-background-networking",
                   "--host-resolver-rules=MAP * ~NOTFOUND", f"--user-data-dir={self._profile}",
                   f"--window-size={width},{height}", "about:blank"]
        self._process = subprocess.Popen(command, preexec_fn=at_3_and_4, close_fds=False,
                                         stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_read)
        os.close(to_write)
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self._session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log"):
            self.call(domain + ".enable")
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._process.terminate()
        try:
            self._process.wait(20)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        shutil.rmtree(self._profile, ignore_errors=True)

    def _receive(self, deadline):
        while b"\0" not in self._buffer:
            if not select.select([self._from], [], [], max(0.0, deadline - time.monotonic()))[0]:
                raise TimeoutError("the browser does not answer")
            part = os.read(self._from, 1 << 20)
            if not part:
                raise RuntimeError("the browser has ended")
            self._buffer += part
        text, self._buffer = self._buffer.split(b"\0", 1)
        message = json.loads(text)
        method, what = message.get("method"), message.get("params", {})
        if method == "Runtime.exceptionThrown":
            details = what["exceptionDetails"]
            self.errors.append(details.get("exception", {}).get("description") or details["text"])
        elif method == "Runtime.consoleAPICalled" and what["type"] in ("error", "warning", "assert"):
            self.errors.append(" ".join(str(a.get("value", a.get("description"))) for a in what["args"]))
        elif method == "Log.entryAdded" and what["entry"]["level"] == "error":
            self.errors.append(what["entry"]["text"])
        return message

    def call(self, method, timeout_s=120, **params):
        """One command of the protocol, and its answer."""
        self._number += 1
        message = {"id": self._number, "method": method, "params": params}
        if self._session:
            message["sessionId"] = self._session
        data = json.dumps(message).encode() + b"\0"
        while data:
            data = data[os.write(self._to, data):]
        deadline = time.monotonic() + timeout_s
        while True:
            answer = self._receive(deadline)
            if answer.get("id") == self._number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']['message']}")
                return answer["result"]

    def evaluate(self, expression, timeout_s=120):
        """What an expression is in the page, promises awaited."""
        result = self.call("Runtime.evaluate", timeout_s, expression=expression, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in result:
            details = result["exceptionDetails"]
            raise RuntimeError(details.get("exception", {}).get("description") or details["text"])
        return result["result"].get("value")

    def open(self, path, timeout_s=120):
        """Opens a report from disk and waits until it is ready."""
        self.call("Page.navigate", url="file://" + os.path.abspath(path))
        deadline = time.monotonic() + timeout_s
        while self.evaluate("document.body && document.body.dataset.ready") != "true":
            if time.monotonic() > deadline or self.errors:
                raise RuntimeError(f"{path} does not get ready: {self.errors}")
            time.sleep(0.1)

    def screenshot(self, path=None):
        """The page as a PNG file's bytes, written to `path` where one is given."""
        png = base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"])
        if path:
            with open(path, "wb") as file:
                file.write(png)
        return png

    def seek(self, view):
        """Moves the slider as a hand would, and waits until it is drawn."""
        self.evaluate(f"""new Promise((done) => {{
            const slider = document.getElementById("slider");
            slider.value = {view};
            slider.dispatchEvent(new Event("input", {{ bubbles: true }}));
            requestAnimationFrame(() => requestAnimationFrame(() => done(true)));
        }})""")
