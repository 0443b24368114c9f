# Measures vs lsp on a program of 500 lines: milliseconds from an edit to the diagnostics, and of a completion; the median
# and the greatest of RUNS (21) each. editor.py VS
import json, os, statistics, subprocess, sys, time

runs = int(os.environ.get("RUNS", 21))
server = subprocess.Popen([sys.argv[1], "lsp"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
uri, storey = "file:///tower.vs", '''(define (storey-{0} width height [turn any? 0])
  (let* ([foot (make-box origin width width height)]
         [band (make-box (xyz 0 0 height) width width (* 0.1 height))])
    (do-rotate (unite foot band) 'z turn)))
(draw (do-move (storey-{0} 4 3) (vxyz 0 0 (* 3 {0}))))
'''
text = "".join(storey.format(i) for i in range(100))

def send(method, parameters, number=None):
    body = json.dumps({"jsonrpc": "2.0", "id": number, "method": method, "params": parameters} if number else
                      {"jsonrpc": "2.0", "method": method, "params": parameters}).encode()
    server.stdin.write(b"Content-Length: %d\r\n\r\n" % len(body) + body)
    server.stdin.flush()

def receive():
    size = int(server.stdout.readline().split(b":")[1])
    server.stdout.readline()
    return json.loads(server.stdout.read(size))

def timed(name, act):
    times = []
    for i in range(runs):
        begin = time.perf_counter()
        act(i)
        receive()
        times.append(1000 * (time.perf_counter() - begin))
    print(f"{name}: median {statistics.median(times):.0f} ms, most {max(times):.0f} ms")

send("initialize", {}, 1)
receive()
send("textDocument/didOpen", {"textDocument": {"uri": uri, "text": text}})
receive()
place = {"line": 1, "character": 25}
timed("diagnostics after an edit of 500 lines", lambda i: send("textDocument/didChange", {
    "textDocument": {"uri": uri}, "contentChanges": [{"range": {"start": place, "end": place}, "text": " "}]}))
timed("completion of make-", lambda i: send("textDocument/completion", {
    "textDocument": {"uri": uri}, "position": {"line": 1, "character": 23 + 7}}, i + 2))
server.stdin.close()
