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

    def width_overflow(self) -> float:
        """By how much the page is wider than its window [px]."""
        return float(self.run("return document.documentElement.scrollWidth - innerWidth"))

    def screenshot(self) -> Any:
        """The window as an array (height, width, 3)."""
        import cv2
        import numpy as np

        content = np.frombuffer(self.driver.get_screenshot_as_png(), dtype=np.uint8)
        return cv2.imdecode(content, cv2.IMREAD_COLOR)
