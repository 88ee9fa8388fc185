#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the pcl_flashreg authors
"""Filters a Markdown page on its way to Doxygen, which gives headings no names that links
could be written with: page.md#a-heading, as everybody else has it, becomes a label of the
page and the heading. Writes to standard output, a line for a line."""

import os
import re
import sys

HEADING = re.compile(r"^(#{1,4}) (.*?)\s*$")
LINK = re.compile(r"\]\(([^)#\s:]*)(#[^)\s]+)?\)")


def slug(text):
    """As code hosting sites name headings."""
    return re.sub(r"[^\w\- ]", "", text.lower()).replace(" ", "-")


def page_of(path):
    return os.path.splitext(os.path.basename(path))[0].lower()


def link_on(page):
    def replaced(match):
        target, heading = match.group(1), match.group(2)
        if target and not target.endswith(".md"):
            return match.group(0)
        name = page_of(target) if target else page
        return f"](@ref {name}-{heading[1:]})" if heading else f"](@ref {name}-page)"
    return replaced


def main(path):
    page, titled, in_code = page_of(path), False, False
    for line in open(path, encoding="utf-8"):
        if line.startswith("```"):
            in_code = not in_code
        heading = None if in_code else HEADING.match(line)
        if heading and not titled:
            titled = True
            line = f"# {heading.group(2)} {{#{page}-page}}\n"
        elif heading:
            line = f"{heading.group(1)} {heading.group(2)} {{#{page}-{slug(heading.group(2))}}}\n"
        elif not in_code and not line.startswith("    "):
            line = LINK.sub(link_on(page), line)
        sys.stdout.write(line)


if __name__ == "__main__":
    main(sys.argv[1])
