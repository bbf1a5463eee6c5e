"""A worker that does one thing wrong: ``rogue_worker.py HOW``. Plain Python, as foreign ones."""

import json
import subprocess
import sys
import time

HOW = sys.argv[1] if len(sys.argv) > 1 else "well"


def main():
    if HOW == "child":  # leaves somebody behind
        child = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(60)"])
        print(child.pid, file=sys.stderr, flush=True)
    if HOW == "chatter":
        print("Welcome to the simulator", flush=True)
    for line in sys.stdin:
        request = json.loads(line)
        method = request["method"]
        result = {}
        if method == "hello":
            result = {"protocol": "etot.worker/1", "name": "toy", "joints": 6, "offers": ["look"]}
            if HOW == "version":
                result["protocol"] = "etot.worker/2"
            if HOW == "axes":
                result["joints"] = 7
        elif method == "state":
            result = {"joints": [0.0] * 6, "targets": [0.0] * 6, "opening": 0.08, "time_s": 1.0}
            if HOW == "lies":
                result["joints"] = "in order"
            if HOW == "nan":
                result["joints"][0] = float("nan")
            if HOW == "few":
                result["joints"] = [0.0]
            if HOW == "die":
                print("segmentation fault", file=sys.stderr, flush=True)
                sys.exit(7)
            if HOW == "hang":
                time.sleep(60)
            if HOW == "flood":
                while True:
                    sys.stdout.write("x" * 65536)
            if HOW == "others":
                request["id"] = 4711
        elif method in ("follow", "wait"):
            result = {"end": "done"}
            if HOW == "limit":
                print(json.dumps({"id": request["id"],
                                  "error": {"kind": "stopped", "message": "workspace limit"}}),
                      flush=True)  # fmt: skip
                continue
        elif method == "look":
            result = {"objects": {"ball": {"position": [1, 2, 3], "quaternion": [1, 0, 0, 0]}}}
            if HOW == "blind":
                result["objects"] = {}
            if HOW == "far":
                result["objects"]["ball"]["position"][0] = 1e300
            if HOW == "flat":
                result["objects"]["ball"]["quaternion"] = [0, 0, 0, 0]
        print(json.dumps({"id": request["id"], "result": result}), flush=True)
        if method == "close":
            break


main()
