"""A real browser that opens pages: Debian's chromium, driven headless."""

from __future__ import annotations

import json
import shutil
from dataclasses import dataclass
from pathlib import Path
from typing import Any

FLAGS = (
    "--headless=new",
    "--no-sandbox",
    "--disable-gpu",
    "--enable-unsafe-swiftshader",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-dev-shm-usage",
    "--hide-scrollbars",
    "--window-size=1400,1000",
)

FAINT = """
const brush = Object.assign(document.createElement("canvas"), {width: 1, height: 1})
  .getContext("2d", {willReadFrequently: true});
const over = (colors) => {  // the colours, first ones below, as r g b
  brush.clearRect(0, 0, 1, 1);
  for (const color of colors) { brush.fillStyle = color; brush.fillRect(0, 0, 1, 1); }
  return [...brush.getImageData(0, 0, 1, 1).data].slice(0, 3);
};
const light = (rgb) => rgb.map(v => v / 255)
  .map(v => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
  .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
const found = [];
for (const element of document.querySelectorAll("body *")) {
  const text = [...element.childNodes].filter(n => n.nodeType === 3 && n.textContent.trim());
  if (!text.length || !element.getClientRects().length || element.closest("script, svg")) continue;
  const below = [];
  let veil = 1;
  for (let at = element; at; at = at.parentElement) {
    const style = getComputedStyle(at);
    below.unshift(style.backgroundColor);
    veil *= style.opacity;
  }
  const ground = over(below), color = getComputedStyle(element).color;
  const ink = over([`rgb(${ground})`, color]).map((v, i) => veil * v + (1 - veil) * ground[i]);
  const [dim, bright] = [light(ink), light(ground)].sort((a, b) => a - b);
  const ratio = (bright + 0.05) / (dim + 0.05);
  if (ratio < 4.5) found.push(`${text[0].textContent.trim().slice(0, 40)}: ${ratio.toFixed(2)}`);
}
return [...new Set(found)];
"""


def missing() -> str:
    """Why there is no browser here; empty when there is one."""
    for program in ("chromium", "chromedriver"):
        if shutil.which(program) is None:
            return f"{program} is not installed (Debian: apt-get install chromium chromium-driver)"
    return ""


@dataclass
class Browser:
    """One browser for many pages."""

    driver: Any

    @classmethod
    def start(cls) -> Browser:
        from selenium import webdriver
        from selenium.webdriver.chrome.service import Service

        options = webdriver.ChromeOptions()
        options.binary_location = str(shutil.which("chromium"))
        for flag in FLAGS:
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        service = Service(str(shutil.which("chromedriver")))
        driver = webdriver.Chrome(options=options, service=service)
        driver.set_page_load_timeout(60)
        return cls(driver)

    def open(self, page: Path, *, width: int = 1400, dark: bool = False) -> Browser:
        """Opens a file; what was logged before is forgotten."""
        for log in ("browser", "performance"):
            self.driver.get_log(log)
        self.driver.execute_cdp_cmd(
            "Emulation.setDeviceMetricsOverride",
            {"width": width, "height": 1000, "deviceScaleFactor": 1, "mobile": width < 600},
        )
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [scheme]})
        self.driver.get(page.resolve().as_uri())
        return self

    def run(self, script: str, *arguments: Any) -> Any:
        """What a script returns in the page."""
        return self.driver.execute_script(script, *arguments)

    def complaints(self) -> list[str]:
        """What the page wrote to its console."""
        entries = [entry["message"] for entry in self.driver.get_log("browser")]
        # How the software renderer of a headless browser feels about screenshots.
        return [entry for entry in entries if "GL Driver Message" not in entry]

    def fetched(self) -> list[str]:
        """Addresses outside the file that the page asked for."""
        addresses = []
        for entry in self.driver.get_log("performance"):
            event = json.loads(entry["message"])["message"]
            if event["method"] == "Network.requestWillBeSent":
                addresses.append(str(event["params"]["request"]["url"]))
        return [a for a in addresses if not a.startswith(("data:", "blob:", "file:"))] + [
            a for a in addresses if a.startswith("file:") and not a.endswith("report.html")
        ]

    def opened_in_s(self) -> float:
        """From asking for the page to its being loaded and laid out [s]."""
        script = "const t = performance.getEntriesByType('navigation')[0]; return t.loadEventEnd"
        return float(self.run(script)) / 1000

    def misfits(self) -> list[str]:
        """What is wider than its place, as ``element: how wide > how much room`` [px].

        The page itself, and whatever would have to be scrolled sideways to be seen; but a strip of
        cards, which a finger is used to pushing.
        """
        script = """return [...document.querySelectorAll("*")].filter(e =>
            e.clientWidth && e.scrollWidth > e.clientWidth + 1 && !e.matches(".strip")
            && (e === document.documentElement
              || ["auto", "scroll"].includes(getComputedStyle(e).overflowX)))
          .map(e => `${e.tagName} ${e.className}: ${e.scrollWidth} > ${e.clientWidth}`)"""
        return [str(found) for found in self.run(script)]

    def faint(self) -> list[str]:
        """Text of less than 4.5 : 1 contrast with what it stands on (WCAG 2, level AA)."""
        return [str(found) for found in self.run(FAINT)]

    def check_looks(self, page: Path) -> None:
        """Opens a page wide and narrow, light and dark: all of it fits and can be read."""
        for width in (1400, 390):
            self.open(page, width=width)
            assert self.misfits() == [], width
        for dark in (False, True):
            self.open(page, dark=dark)
            assert self.faint() == [], "dark" if dark else "light"

    def screenshot(self) -> Any:
        """The window as an array (height, width, 3)."""
        import cv2
        import numpy as np

        content = np.frombuffer(self.driver.get_screenshot_as_png(), dtype=np.uint8)
        return cv2.imdecode(content, cv2.IMREAD_COLOR)
