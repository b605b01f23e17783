"""What is wrong with links of a folder of HTML files: targets that are not there, and resources of other hosts."""

import html.parser
import pathlib
import re
import urllib.parse


class Page(html.parser.HTMLParser):
    """Its anchors, links and what it loads."""

    def __init__(self, text):
        super().__init__()
        self.anchors, self.links, self.resources = set(), [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        has = dict(attributes)
        self.anchors |= {has[key] for key in ("id", "name") if has.get(key)}
        if tag == "a" and has.get("href"):
            self.links.append(has["href"])
        elif tag == "link" and has.get("href") and has.get("rel") != "canonical":
            self.resources.append(has["href"])
        elif tag in ("script", "img", "iframe", "source", "video", "audio") and has.get("src"):
            self.resources.append(has["src"])


def is_foreign(url):
    return bool(re.match(r"(?:[a-z][a-z0-9+.-]*:)?//", url))


def pages_of(folder):
    return {path: Page(path.read_text(errors="replace")) for path in sorted(folder.rglob("*.html"))}


def broken_links(folder):
    """A line for each link to a file or an anchor of the folder that is not there. Pages of the C++ reference are only linked to."""
    pages, found = pages_of(folder), []
    for path, page in pages.items():
        if "cpp" in path.relative_to(folder).parts or path.name == "404.html":
            continue
        for url in [*page.links, *page.resources]:
            if is_foreign(url) or re.match(r"[a-z]+:", url):
                continue
            file, _, anchor = url.partition("#")
            target = (path.parent / urllib.parse.unquote(file.partition("?")[0])).resolve() if file else path
            if target.is_dir():
                target = target / "index.html"
            if not target.exists():
                found.append(f"{path.relative_to(folder)}: {url}: no such file")
            elif anchor and target in pages and urllib.parse.unquote(anchor) not in pages[target].anchors:
                found.append(f"{path.relative_to(folder)}: {url}: no such heading")
    return found


def foreign_resources(folder):
    """A line for each script, style, font or picture that a page would load from another host."""
    found = [f"{path.relative_to(folder)}: {url}: loaded from another host" for path, page in pages_of(folder).items() for url in page.resources if is_foreign(url)]
    for path in sorted(folder.rglob("*.css")):
        found += [f"{path.relative_to(folder)}: {url}: loaded from another host"
                  for url in re.findall(r"(?:url\(|@import )[\"']?((?:https?:)?//[^\"')]+)", path.read_text(errors="replace"))]
    return found
