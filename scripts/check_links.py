#!/usr/bin/env python3
"""Checks the links of a folder of HTML: every address that is not of the web is a file of the folder, and has the anchor that is asked for.

Takes a second. Knows nothing of addresses that scripts make. `check_links.py FOLDER` ends with 1 and a line for each link that leads nowhere;
`check_links.py --plant` is the control: a folder with one sound page and one broken link of each kind.
"""

import sys
import tempfile
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

# The page that a host shows where there is none; its addresses are from the root of that host.
IGNORED = {"404.html"}


class Page(HTMLParser):
    """Addresses and anchors of a page."""

    def __init__(self, text):
        super().__init__()
        self.addresses, self.anchors = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("href", "src") and value:
                self.addresses.append(value)
            if name == "id" or (name == "name" and tag == "a"):
                self.anchors.add(value)


def faults(folder):
    """Links that lead nowhere, as lines."""
    files = sorted(folder.rglob("*.html"))
    pages = {path: Page(path.read_text(encoding="utf-8")) for path in files}
    checked, found = 0, []
    for path, page in pages.items():
        if path.name in IGNORED:
            continue
        for address in page.addresses:
            parts = urlsplit(address)
            if parts.scheme in ("http", "https", "mailto", "data"):
                continue
            checked += 1
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            if target.is_dir():
                target /= "index.html"
            name = path.relative_to(folder)
            if parts.scheme or not target.is_relative_to(folder) or not target.is_file():
                found.append(f"{name}: there is no {address}")
            elif parts.fragment and unquote(parts.fragment) not in pages.get(target, Page("")).anchors:
                found.append(f"{name}: {address} has no such heading")
    return checked, found


def main():
    if sys.argv[1:] == ["--plant"]:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name).resolve()
            (folder / "sound.html").write_text('<h1 id="a">A</h1><a href="#a">a</a><a href="https://example.org">out</a>')
            (folder / "broken.html").write_text(
                '<a href="none.html">1</a><a href="sound.html#b">2</a><img src="../../x.png"><a href="file:///etc">4</a>'
            )
            _, found = faults(folder)
            print("\n".join(found))
            return 0 if len(found) == 4 else 1
    checked, found = faults(Path(sys.argv[1]).resolve())
    print("\n".join([*found, f"{checked} links, {len(found)} lead nowhere"]))
    return 1 if found or checked == 0 else 0


sys.exit(main())
