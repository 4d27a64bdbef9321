"""No page loads anything from elsewhere, and no link between pages is dead: `python docs/links.py FOLDER-OF-HTML`."""

from __future__ import annotations

import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urldefrag


class Page(HTMLParser):
    """What a page links to and loads, and the places in it to which one can link."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.links: list[str] = []
        self.loads: list[str] = []
        self.anchors: set[str] = set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Called for each tag."""
        given = {name: value or "" for name, value in attrs}
        self.anchors.add(given.get("id", ""))
        if tag == "a" and "href" in given:
            self.links.append(given["href"])
        if tag in ("script", "img", "iframe") and "src" in given:
            self.loads.append(given["src"])
        if tag == "link" and given.get("rel") in ("stylesheet", "icon", "preload"):
            self.loads.append(given["href"])


def problems(root: Path) -> list[str]:
    """One line for each dead link, and for each thing that would come from elsewhere."""
    pages = {path.resolve(): Page(path) for path in root.rglob("*.html")}
    found = []
    for path, page in pages.items():
        for link in page.links + page.loads:
            if link.startswith(("http://", "https://", "//")):
                if link in page.loads:
                    found.append(f"{path}: loads {link}")
                continue
            target, anchor = urldefrag(unquote(link).partition("?")[0])
            there = (path.parent / target).resolve() if target else path
            if not there.exists():
                found.append(f"{path}: {link} leads nowhere")
            elif anchor and there in pages and anchor not in pages[there].anchors:
                found.append(f"{path}: {link} has no such place")
    return found


if __name__ == "__main__":
    dead = problems(Path(sys.argv[1]))
    print("\n".join(dead) or "every link leads somewhere, and nothing is loaded from elsewhere")
    raise SystemExit(bool(dead))
