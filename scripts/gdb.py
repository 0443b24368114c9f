# Prints Scheme values and model nodes in gdb: `source scripts/gdb.py`, then `print v`, `print *n`, or `vs-node n` for a subtree.
import gdb
import struct

TAG_FIXNUM, TAG_IMMEDIATE, TAG_POINTER = 0xFFF9, 0xFFFA, 0xFFFB
PAYLOAD = (1 << 48) - 1
IMMEDIATES = {(0, 0): '#f', (0, 1): '#t', (1, 0): '()', (2, 0): '#<unspecific>', (3, 0): '#<eof>', (4, 0): '#<absent>',
              (5, 0): '#<undefined>', (6, 0): '#<vacant>'}
DEPTH = 6  # of lists within lists that are shown


def names(prefix):
    """The enumerators VS_T_... or the like, from the program's own symbols, by number."""
    found, n = {}, 0
    if prefix == 'VS_T_':
        with open('vm/values/object.def') as rows:
            for row in rows:
                if row.startswith('VS_OBJECT('):
                    found[n] = row[len('VS_OBJECT('):].split(',')[0].strip()
                    n += 1
    return found


def kinds():
    found = []
    with open('model/prims.def') as rows:
        for row in rows:
            if row.startswith('VS_KIND('):
                found.append(row[len('VS_KIND('):].split(',')[1].strip())
    return found


def show(word, depth=0):
    """The text of a vs_value, given as a whole number."""
    tag = word >> 48
    if tag < TAG_FIXNUM:
        return repr(struct.unpack('d', struct.pack('Q', word))[0])
    if tag == TAG_FIXNUM:
        n = word & PAYLOAD
        return str(n - (1 << 48) if n >> 47 else n)
    if tag == TAG_IMMEDIATE:
        kind, n = (word >> 32) & 0xFFFF, word & 0xFFFFFFFF
        return '#\\' + chr(n) if kind == 7 else IMMEDIATES.get((kind, n), '#<immediate %d %d>' % (kind, n))
    address = word & PAYLOAD
    at = lambda name: gdb.Value(address).cast(gdb.lookup_type(name).pointer()).dereference()
    kind = names('VS_T_').get(int(at('vs_object')['type']), '?')
    if kind == 'SYMBOL':
        return at('vs_symbol')['name'].address.cast(gdb.lookup_type('char').pointer()).string()
    if kind == 'PAIR':
        if depth > DEPTH:
            return '(...)'
        items = []
        while True:
            pair = at('vs_pair')
            items.append(show(int(pair['car']), depth + 1))
            rest = int(pair['cdr'])
            if rest >> 48 == TAG_POINTER and len(items) < 20:
                address = rest & PAYLOAD
                at = lambda name, a=address: gdb.Value(a).cast(gdb.lookup_type(name).pointer()).dereference()
                if names('VS_T_').get(int(at('vs_object')['type'])) == 'PAIR':
                    continue
            if show(rest, depth + 1) != '()':
                items += ['.', show(rest, depth + 1)]
            return '(' + ' '.join(items) + ')'
    if kind == 'FLAT':
        flat = at('vs_flat')
        return '#<flat %d: %s>' % (int(flat['h']['flags']), ' '.join(str(float(flat['at'][i])) for i in range(int(flat['h']['words']) - 1)))
    return '#<%s 0x%x>' % (kind.lower(), address)


class ValuePrinter:
    def __init__(self, value):
        self.value = value

    def to_string(self):
        return show(int(self.value))


def lookup(value):
    return ValuePrinter(value) if value.type.name == 'vs_value' else None


class ShowNode(gdb.Command):
    """vs-node EXPRESSION: the subtree of a vs_node, one node a line, children indented, eight deep."""

    def __init__(self):
        super().__init__('vs-node', gdb.COMMAND_DATA)

    def invoke(self, argument, from_tty):
        table = kinds()
        stack = [(gdb.parse_and_eval(argument), 0)]
        while stack:
            node, depth = stack.pop()
            kind = table[int(node['kind'])]
            payload = node['children'][int(node['child_count'])].address
            data = payload.cast(gdb.lookup_type('struct vs_' + kind).pointer()).dereference()
            print('%s%s refs %d %s' % ('  ' * depth, kind, int(node['refs']), data if depth < 8 else ''))
            if depth < 8:
                for i in reversed(range(int(node['child_count']))):
                    stack.append((node['children'][i]['node'], depth + 1))


gdb.pretty_printers.append(lookup)
ShowNode()
