# Tests `vs jupyter` with nbclient and jupyter_client: jupyter.py VS FOLDER ONLY. Prints `ok NAME`, or `not ok NAME` and
# its reasons.
import json, os, pathlib, re, subprocess, sys, time

vs, work, only = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve(), sys.argv[3]
os.environ["JUPYTER_DATA_DIR"] = str(work / "data")
os.environ["JUPYTER_RUNTIME_DIR"] = str(work / "runtime")
os.environ["JUPYTER_PLATFORM_DIRS"] = "0"
try: import nbclient, nbformat, jupyter_client
except ImportError as e:
    print(f"skip desk/jupyter: {e} (python3-nbclient)")
    sys.exit()

done = subprocess.run([vs, "jupyter"], capture_output=True, text=True)
spec = work / "data/kernels/visualscheme/kernel.json"

def install():
    reasons = []
    if done.returncode or done.stdout.strip() != str(spec): reasons.append(f"vs jupyter: {done}")
    if json.loads(spec.read_text())["argv"][1:] != ["jupyter", "{connection_file}"]: reasons.append(spec.read_text())
    if "visualscheme" not in jupyter_client.kernelspec.KernelSpecManager().find_kernel_specs(): reasons.append("Jupyter does not find the kernel")
    return reasons

# A notebook runs under nbclient: values, printed text, the drawing, an error with its place and advice.
def notebook():
    reasons = []
    book = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(c) for c in (
        "(define (f x) (* x 2))\n(f 21)", '(display "ü😀") 1/3 (f 2)', "(draw (make-box origin (xyz 1 2 3)))", "(f 1)",
        "(draw (make-bx origin 1 2 3))", '(display "after")', "(car '())")])
    book.metadata.kernelspec = {"name": "visualscheme", "display_name": "VisualScheme", "language": "scheme"}
    nbclient.NotebookClient(book, timeout=60, kernel_name="visualscheme", allow_errors=True).execute()
    out = [[(o.output_type, o.get("text") or (o.get("data") or {}).get("text/plain") or o.get("evalue")) for o in c.outputs] for c in book.cells]
    want = [[("execute_result", "42")], [("stream", "ü😀1/3 ; 0.333333\n"), ("execute_result", "4")], None, [("execute_result", "2")],
            [("error", "In [5]:1:7: make-bx is not defined; did you mean make-box?")], [("stream", "after")], [("error", r"In \[7\]:1:1: car: .*")]]
    for i, w in enumerate(want):
        if w is None: continue
        got = [(k, t) for k, t in out[i] if k != "stream"]
        printed = "".join(t for k, t in out[i] if k == "stream")
        if printed: got = [("stream", printed)] + got
        if len(got) != len(w) or any(a[0] != b[0] or not (a[1] == b[1] or re.fullmatch(b[1], a[1])) for a, b in zip(got, w)): reasons.append(f"cell {i + 1}: {out[i]}")
    shown = [o for o in book.cells[2].outputs if o.output_type == "display_data"]
    if len(shown) != 1 or not shown[0].data["text/html"].startswith("<iframe") or "canvas" not in shown[0].data["text/html"]: reasons.append(f"the drawing: {str(shown)[:300]}")
    if any(o.output_type == "display_data" for c in book.cells[3:] for o in c.outputs): reasons.append("a drawing that did not change is shown again")
    if [c.execution_count for c in book.cells] != list(range(1, 8)): reasons.append(f"counts: {[c.execution_count for c in book.cells]}")
    return reasons

# Completion, help, unfinished texts, an interrupt, a restart, a wrong signature, the end.
def requests():
    reasons = []
    manager, client = jupyter_client.manager.start_new_kernel(kernel_name="visualscheme", startup_timeout=30)
    try:
        ask = lambda r: client.get_shell_msg(timeout=30)["content"]
        client.execute("(define größe 3)"); ask(0)
        client.complete("(+ größe (make-sph", 18)
        a = ask(0)
        if (a["matches"], a["cursor_start"], a["cursor_end"]) != (["make-sphere"], 10, 18): reasons.append(f"completion: {a}")
        client.inspect("(make-box 1)", 4)
        a = ask(0)
        if not a["found"] or "(make-box p q)" not in a["data"]["text/plain"]: reasons.append(f"help: {a}")
        client.inspect("(none-such 1)", 4)
        if ask(0)["found"]: reasons.append("help on a name that is not there")
        for code, state in (("(f 1)", "complete"), ("(f 1", "incomplete"), ("(f 1]", "invalid"), ("", "complete")):
            client.is_complete(code)
            a = ask(0)
            if a["status"] != state: reasons.append(f"{code!r}: {a}")
        client.execute("(let loop () (loop))")
        time.sleep(1)
        if not client.hb_channel.is_beating(): reasons.append("no heartbeat while a cell runs")
        manager.interrupt_kernel()
        a = ask(0)
        if a["status"] != "error" or "interrupted" not in a["evalue"]: reasons.append(f"an interrupt: {a}")
        client.execute("größe", silent=False)
        if ask(0)["status"] != "ok": reasons.append("the program is lost after an interrupt")
        key = client.session.key
        client.session.key = b"wrong"
        client.execute('(exit 3)')
        client.session.key = key
        client.execute("(+ 1 1)")
        if ask(0)["status"] != "ok": reasons.append("a message with a wrong signature was taken")
        client.history(); ask(0)
        client.comm_info(); ask(0)
        manager.restart_kernel()
        client.wait_for_ready(timeout=30)
        client.execute("größe")
        if ask(0)["status"] != "error": reasons.append("a restart keeps the program")
        manager.shutdown_kernel(now=False)
        if manager.is_alive(): reasons.append("the kernel goes on after shutdown")
    finally:
        client.stop_channels()
        if manager.is_alive(): manager.shutdown_kernel(now=True)
    return reasons

def wrong():
    reasons = []
    (work / "bad.json").write_text("{")
    (work / "taken.json").write_text('{"ip": "999.0.0.1", "transport": "tcp", "shell_port": 1, "iopub_port": 2, "stdin_port": 3, "control_port": 4, "hb_port": 5, "key": ""}')
    for file in ("none.json", "bad.json", "taken.json"):
        r = subprocess.run([vs, "jupyter", work / file], capture_output=True, text=True, timeout=30)
        if r.returncode != 2 or len(r.stderr.strip().split("\n")) != 1: reasons.append(f"{file}: {r}")
    r = subprocess.run([vs, "jupyter", "a", "b"], capture_output=True, text=True, timeout=30)
    if r.returncode != 2: reasons.append(f"two files: {r}")
    return reasons

# Messages that no client sends; a long error in letters of several bytes; Jupyter ends without a word, idle and while a cell runs.
def hostile():
    reasons = []
    manager, client = jupyter_client.manager.start_new_kernel(kernel_name="visualscheme", startup_timeout=30)
    try:
        ask = lambda r: client.get_shell_msg(timeout=30)["content"]
        session, socket = client.session, client.shell_channel.socket
        parts = session.serialize(session.msg("execute_request", {"code": "1"}))
        mark = parts.index(b"<IDS|MSG>")
        for bad in ([], [b"x"], [b"x"] * 100, parts[:mark + 3], parts[:mark + 1] + [b""] + parts[mark + 2:], parts[:mark + 1] + [b"\xff" * 64] + parts[mark + 2:], parts[mark + 1:], parts[:mark] + [b"<IDS|MSG>"] * 9):
            socket.send_multipart(bad or [b""])
        def signed(*four): return [b"<IDS|MSG>", session.sign(list(four)), *four]
        for four in ((b"{", b"{}", b"{}", b"{}"), (b"{}", b"{}", b"{}", b"{}"), (b'{"msg_type":5}', b"{}", b"{}", b"{}"), (b'{"msg_type":"execute_request"}', b"{}", b"{}", b"\xff"), (b'{"msg_type":"execute_request"}', b"{}", b"{}", b"[" * 100000), (b"[]", b"[]", b"[]", b"[]")): socket.send_multipart(signed(*four))
        for content in ({}, {"code": 5}, {"code": None, "silent": "x"}): session.send(socket, "execute_request", content); ask(0)
        for content in ({}, {"code": "(make-b", "cursor_pos": -5}, {"code": "(make-b", "cursor_pos": 1 << 40}, {"code": "ü😀", "cursor_pos": 1}):
            for kind in ("complete_request", "inspect_request", "is_complete_request"): session.send(socket, kind, content); ask(0)
        for shift in range(4):
            client.execute(f'(error "{"x" * shift}{"😀" * 400}")')
            if ask(0)["status"] != "error": reasons.append("a long error")
        client.execute("(+ 1 1)")
        if ask(0)["status"] != "ok": reasons.append("the kernel is lost")
        manager.shutdown_kernel(now=False)
    finally:
        client.stop_channels()
        if manager.is_alive(): manager.shutdown_kernel(now=True)
    for code in ("1", "(let loop () (loop))"):
        starter = f"import jupyter_client, os, sys, time\nm, c = jupyter_client.manager.start_new_kernel(kernel_name='visualscheme')\nc.execute({code!r})\ntime.sleep(1)\nprint(m.provisioner.pid, flush=True)\nos._exit(0)"
        pid = int(subprocess.run([sys.executable, "-c", starter], capture_output=True, text=True, timeout=60, check=True).stdout)
        for _ in range(100):
            try: gone = pathlib.Path(f"/proc/{pid}/stat").read_text().split(")")[1].split()[0] == "Z"
            except OSError: gone = True
            if gone: break
            time.sleep(0.1)
        if not gone: reasons.append(f"the kernel goes on without Jupyter after {code}"); os.kill(pid, 9)
    return reasons

for test in (install, notebook, requests, wrong, hostile):
    name = "desk/jupyter:" + test.__name__
    if only and only not in name: continue
    try: reasons = test()
    except Exception as e: reasons = [repr(e)]
    print(f"not ok {name}" if reasons else f"ok {name}")
    for reason in reasons[:8]: print("    " + str(reason)[:900])
