"""How speed.py runs programs and keeps what they took, so that it can be stopped and go on."""
import dataclasses
import json
import os
import subprocess
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))


@dataclasses.dataclass
class Run:
    """What a command printed and took, from the start of its process to its end."""
    out: str
    wall: float       # seconds
    processor: float  # seconds of all threads, user and system
    peak: int         # bytes of memory at most
    load: float       # of the machine when it ended, mean of a minute


def fail(text, code=4):
    """code: 4 where a program failed, 2 where the command line or what is installed is wrong."""
    print(f"speed: error: {text}", file=sys.stderr)
    sys.exit(code)


def run(command, environment=None):
    with tempfile.TemporaryFile("w+") as out, tempfile.TemporaryFile("w+") as talk:
        start = time.monotonic()
        process = subprocess.Popen(command, stdout=out, stderr=talk, stdin=subprocess.DEVNULL,
                                   env=dict(os.environ, **(environment or {})))
        _, status, usage = os.wait4(process.pid, 0)
        wall = time.monotonic() - start
        process.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0), talk.seek(0)
        printed, said = out.read(), talk.read()
    if process.returncode:
        fail(f"{' '.join(command)}: ended with {process.returncode}\n{printed[-1000:]}{said[-1000:]}")
    return Run(printed, wall, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024, os.getloadavg()[0])


def first_line(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.split("\n")[0].strip()


def processor():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        names = [line.split(":")[1].strip() for line in file if line.startswith("model name")]
    return f"{len(os.sched_getaffinity(0))} of {len(names)} x {names[0] if names else 'unknown'}"


class Kept:
    """Measurements in FOLDER/speed.json, each under a name that says what was measured."""

    def __init__(self, folder, settings):
        self.folder, self.path = folder, folder + "/speed.json"
        self.root = {"settings": settings, "runs": {}, "table": []}
        if not os.path.exists(self.path):
            return
        with open(self.path, encoding="utf-8") as file:
            self.root = json.load(file)
        old = self.root["settings"]
        different = [f"{k}: {old.get(k)} there, {v} now" for k, v in settings.items() if old.get(k) != v]
        if different:
            fail(f"{self.path}: was begun with something else ({'; '.join(different)}); use another folder or what it "
                 "was begun with", 2)

    def get(self, name, make):
        """The measurement of that name: a dictionary, made now where there is none yet."""
        if name not in self.root["runs"]:
            print(f"{time.strftime('%H:%M:%S')} {name}", file=sys.stderr, flush=True)
            self.root["runs"][name] = make()
            self.save()
        return self.root["runs"][name]

    def under(self, prefix):
        """Measurements whose names are prefix/NUMBER, in the order of the numbers."""
        names = [n for n in self.root["runs"] if n.rpartition("/")[0] == prefix]
        return [self.root["runs"][n] for n in sorted(names, key=lambda n: int(n.rpartition("/")[2]))]

    def save(self):
        write_whole(self.path, json.dumps(self.root, indent=1) + "\n")


def write_whole(path, text):
    with open(path + ".tmp", "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(path + ".tmp", path)


class Street:
    """What all parts render: paths of the programs and files, and the sizes that were asked for."""

    def __init__(self, options):
        self.options, self.folder, self.kept = options, options.folder, None
        self.threads = len(os.sched_getaffinity(0))

    def script(self, name, *arguments):
        return [sys.executable, f"{HERE}/{name}", *arguments]

    def day(self):
        return self.options.kaystreet

    def lit(self, lamps):
        """The street with so many lamps."""
        path = f"{self.folder}/lamps_{lamps}.glb"
        if not os.path.exists(path):
            run(self.script("lamps.py", self.options.kaystreet, path, str(lamps)))
        return path

    def environment(self, time_of_day):
        """The HDR map that both programs read, by day or night: that of references.py."""
        import references  # needs python3-openimageio, which not every part does
        path = f"{self.folder}/{time_of_day}.exr"
        if not os.path.exists(path):
            illuminance, sun_share = references.LIGHT[time_of_day]
            references.write_exr(path, references.environment(illuminance, sun_share), ["R", "G", "B"])
        return path

    def pluvia(self, scene, output, *arguments):
        """Renders with `pluvia render`; its measurement with what --json and frame.json count."""
        done = run([self.options.pluvia, "render", scene, "-o", output, "--progress", "none", "--json", "--overwrite",
                    *map(str, arguments)])
        record = {"wall": done.wall, "processor": done.processor, "peak": done.peak, "load": done.load}
        with open(output + "/frame.json", encoding="utf-8") as file:
            record["calls"] = json.load(file)["feature_calls"]
        return record | json.loads(done.out)
