#!/usr/bin/env python3
"""Breaks long lines: `scripts/wrap.py FILE...` rewrites lines past 120 columns, and no others.

Comments are broken at a space, and the rest begins the next line of its paragraph; a comment behind code that begins far
to the right goes above that code. Code is broken by clang-format, asked for these lines alone. Lines of macros keep
their backslashes: only padding before one is taken out. `scripts/wrap.py --same OLD NEW FILE...` compares the
tokens of files below two folders after the preprocessor, joined strings counting as one: equal ones compile alike."""
import os
import re
import subprocess
import sys

WIDTH = 120
FAR = 72  # a comment behind code from this column on is narrower than its continuation lines deserve


def comments(line):
    """Returns where a comment opens that this line does not close, or -1, and the span of the last one that it closes."""
    at, quote, closed = 0, None, None
    while at < len(line):
        if quote:
            if line[at] == '\\':
                at += 1
            elif line[at] == quote:
                quote = None
        elif line[at] in '"\'':
            quote = line[at]
        elif line.startswith('//', at):
            break
        elif line.startswith('/*', at):
            end = line.find('*/', at + 2)
            if end < 0:
                return at, closed
            closed = (at, end + 2)
            at = end + 1
        at += 1
    return -1, closed


def cut(line, least):
    """Returns the line up to a space within the width, and the rest; None: there is no space behind `least`."""
    at = line.rfind(' ', 0, WIDTH + 1)
    if at > least and line[at + 1:].strip() == '*/':
        at = line.rfind(' ', 0, at)  # the end of a comment is no line of its own
    return (line[:at].rstrip(), line[at + 1:].lstrip()) if at > least else None


def has_stars(text):
    """Do the continuation lines of this file's comments begin with a star?"""
    inside, stars, bare = False, 0, 0
    for line in text.split('\n'):
        if inside:
            stars += bool(re.match(r'\s*\*( |$)', line))
            bare += bool(line.strip()) and not re.match(r'\s*\*', line)
            inside = '*/' not in line
        else:
            inside = comments(line)[0] >= 0
    return stars >= bare


def wrap_comments(path):
    """Breaks the comments of one file; returns how many lines were broken."""
    text = open(path, encoding='utf8').read()
    mark = ' * ' if has_stars(text) else '   '
    left, done, inside, broken = text.split('\n'), [], False, 0

    def give(lead, rest, at):
        """The rest of a comment's line begins the next line if that goes on with the paragraph, else it is a line."""
        follows = re.match(r'^(\s*\*? *)(.*)$', left[at]) if at < len(left) else None
        on = follows and follows.group(2) and follows.group(1) == lead and not follows.group(2).startswith(('- ', '| ', '/'))
        if on and not rest.endswith('*/'):
            left[at] = lead + rest + ' ' + follows.group(2)
        else:
            left.insert(at, lead + rest)

    at = 0
    while at < len(left):
        line = left[at]
        opens, closed = (-1, None) if inside else comments(line)
        long, macro = len(line) > WIDTH, line.endswith('\\')
        behind = closed and closed[1] == len(line.rstrip()) and not macro
        if macro and long and len(line[:-1].rstrip()) < WIDTH - 1:
            left[at] = line[:-1].rstrip().ljust(WIDTH - 1) + '\\'
            broken += 1
        elif macro:
            inside = '*/' not in line if inside else opens >= 0
        elif opens >= 0:
            inside = True
            after = left[at + 1] if at + 1 < len(left) else ''
            follows = re.match(r'^(\s*\* +)\S', after) or re.match(r'^(\s+)[^\s*]', after)
            two = cut(line, opens + 4) if long else None
            if two:
                blank = after.strip() == '*'
                left[at] = two[0]
                lead = follows.group(1) if follows and not blank else ' ' * opens + (' * ' if blank else mark)
                give(lead, two[1], at + 1)
                broken += 1
        elif inside:
            text_of = re.match(r'^(\s*\*? *)\S', line)
            two = cut(line, len(text_of.group(1)) + 1) if long and text_of else None
            if two:
                left[at] = two[0]
                give(text_of.group(1), two[1], at + 1)
                broken += 1
            inside = '*/' not in left[at]
        elif long and behind and line[:closed[0]].strip() and closed[0] > FAR and line.count('/*') == 1 and \
                not line.lstrip().startswith(('}', 'else')) and \
                (not done or not done[-1].strip() or done[-1].rstrip()[-1] in ';{}:/'):
            left[at] = re.match(r'^\s*', line).group(0) + line[closed[0]:closed[1]]
            left.insert(at + 1, line[:closed[0]].rstrip())
            broken += 1
            continue
        elif long and behind and closed[0] < WIDTH - 24:
            two = cut(line, closed[0] + 4)
            if two:
                left[at] = two[0]
                left.insert(at + 1, ' ' * closed[0] + mark + two[1])
                inside = True
                broken += 1
        done.append(left[at])
        at += 1
    if broken:
        open(path, 'w', encoding='utf8').write('\n'.join(done))
    return broken


def wrap_code(path):
    """Has clang-format break the long lines of one file, as often as it finds any to break."""
    for _ in range(4):
        lines = open(path, encoding='utf8').read().split('\n')
        macro = [line.endswith('\\') or (at > 0 and lines[at - 1].endswith('\\')) for at, line in enumerate(lines)]
        wide = [at + 1 for at, line in enumerate(lines) if len(line) > WIDTH and not macro[at]]
        long = ['--lines=%d:%d' % (at, at) for at in wide]
        if not long:
            return
        subprocess.run(['clang-format', '-i', *long, path], check=True)


def tokens(folder, name):
    """Returns all that the compiler reads of a file, without spaces and with neighbouring strings joined."""
    found = ['-I.', '-Ibuild', '-I/usr/include/freetype2', '-I/usr/include/OpenEXR']
    said = subprocess.run(['gcc', '-E', '-P', '-std=c11', '-D_GNU_SOURCE', *found, name], cwd=folder, capture_output=True, text=True, check=True).stdout
    return re.sub(r'\s+', '', re.sub(r'"\s+"', '', said))


def main(words):
    if words[:1] == ['--same']:
        old, new, names = words[1], words[2], words[3:]
        other = [name for name in names if name.endswith('.c') and tokens(old, name) != tokens(new, name)]
        print('\n'.join(other + ['%d files, %d differ' % (len(names), len(other))]))
        return 1 if other else 0
    strange = [path for path in words if not path.endswith(('.c', '.h', '.def'))]
    if strange:
        print('wrap.py: %s: only C is broken into lines (.c, .h, .def)' % strange[0], file=sys.stderr)
        return 2
    for path in words:
        while wrap_comments(path):
            pass
        wrap_code(path)
        while wrap_comments(path):
            pass
        lines = open(path, encoding='utf8').read().split('\n')
        left = [str(at + 1) for at, line in enumerate(lines) if len(line) > WIDTH]
        if left:
            print('%s: by hand: %s' % (path, ' '.join(left)))
    return 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
