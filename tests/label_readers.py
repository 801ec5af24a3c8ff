"""Reads exported labels with numpy and PIL only, and frame.exr with OpenImageIO, and compares them with the frame's own
planes.

The argument is a folder with the planes as raw numbers, frame.exr, frame.json, and one folder per format. Tables are restated here
from what the formats publish; nothing is taken from Pluvia's."""
import json
import struct
import sys

import numpy as np
from PIL import Image

root = sys.argv[1]
frame = json.load(open(f"{root}/frame.json"))
width, height = (int(2 * frame["camera"]["intrinsics"][k][2]) for k in (0, 1))
shape = (height, width)
CITYSCAPES = {"road": (7, 0), "building": (11, 2), "pole": (17, 5), "polegroup": (18, 255), "sky": (23, 10),
              "person": (24, 11), "car": (26, 13)}
COLORS = {"road": (128, 64, 128), "building": (70, 70, 70), "pole": (153, 153, 153), "polegroup": (153, 153, 153),
          "sky": (70, 130, 180), "person": (220, 20, 60), "car": (0, 0, 142)}
CARLA = {"road": 1, "building": 3, "pole": 6, "polegroup": 6, "sky": 11, "person": 12, "car": 14}
CARLA_OLD = {"road": 7, "building": 1, "pole": 5, "polegroup": 5, "sky": 13, "person": 4, "car": 10}
COCO = {"road": 149, "building": 197, "sky": 187, "person": 1, "car": 3}


def plane(name, kind):
    return np.fromfile(f"{root}/{name}", kind).reshape(shape)


ids, z = plane("instance.ID", "<u4"), plane("Z", "<f4")
objects = {o["id"]: o for o in frame["objects"]}
names = np.full(shape, "sky", dtype=object)
for key, entry in objects.items():
    names[ids == key] = entry["class"]
assert ((ids == 0) == np.isinf(z)).all()


def mapped(table, position=None):
    return np.vectorize(lambda n: table[n] if position is None else table[n][position])(names)


def read(path):
    return np.array(Image.open(f"{root}/{path}"))


def cityscapes():
    stem = "cityscapes/frame_gtFine_"
    assert (read(stem + "labelIds.png") == mapped(CITYSCAPES, 0)).all()
    assert (read(stem + "labelTrainIds.png") == mapped(CITYSCAPES, 1)).all()
    assert (read(stem + "color.png") == np.array([COLORS[n] for n in names.flat]).reshape(*shape, 3)).all()
    instances = read(stem + "instanceIds.png").astype(int)
    countable = np.isin(names, ["car", "person"])
    assert (np.where(countable, instances // 1000, instances) == mapped(CITYSCAPES, 0)).all()
    assert len(np.unique(instances[names == "car"])) == 2
    for code in np.unique(instances[countable]):
        assert len(np.unique(ids[instances == code])) == 1
    # Painted in their order, each polygon over those before, by the centres of pixels.
    result = np.zeros(shape, int)
    y, x = np.mgrid[0:height, 0:width] + 0.5
    document = json.load(open(f"{root}/{stem}polygons.json"))
    for entry in document["objects"]:
        inside = np.zeros(shape, bool)
        points = entry["polygon"]
        for (ax, ay), (bx, by) in zip(points, points[1:] + points[:1]):
            crosses = ((ay > y) != (by > y))
            at = ax + (y - ay) * (bx - ax) / (by - ay if by != ay else 1)
            inside ^= crosses & (at > x)
        result[inside] = CITYSCAPES[entry["label"]][0]
    assert (result == mapped(CITYSCAPES, 0)).all()


def carla():
    for folder, table in (("carla", CARLA), ("carla-0.9.13", CARLA_OLD)):
        tags = read(f"{folder}/semantic/frame.png").astype(int)
        assert (tags[..., 0] == mapped(table)).all() and (tags[..., 1:] == 0).all()
        instance = read(f"{folder}/instance/frame.png").astype(int)
        assert (instance[..., 0] == mapped(table)).all()
        number = instance[..., 1] + 256 * instance[..., 2]
        for value in np.unique(number):
            assert len(np.unique(ids[number == value])) == 1
        code = read(f"{folder}/depth/frame.png").astype(float)
        metres = (code[..., 0] + 256 * code[..., 1] + 65536 * code[..., 2]) / (2**24 - 1) * 1000
        near = np.isfinite(z)
        assert np.abs(metres - z)[near].max() < 1e-4 and (metres[~near] == 1000).all()


def coco():
    document = json.load(open(f"{root}/coco/instances.json"))
    assert {c["id"]: c["name"] for c in document["categories"]}[3] == "car"
    for entry in document["annotations"]:
        counts = entry["segmentation"]["counts"]
        flat = np.repeat(np.arange(len(counts)) % 2, counts)
        mask = flat.reshape(width, height).T.astype(bool)
        key = np.unique(ids[mask])
        assert len(key) == 1 and (mask == (ids == key[0])).all()
        assert entry["area"] == mask.sum() and entry["category_id"] == COCO[objects[key[0]]["class"]]
        ys, xs = np.nonzero(mask)
        assert entry["bbox"] == [xs.min(), ys.min(), xs.max() - xs.min() + 1, ys.max() - ys.min() + 1]
    picture = read("coco/panoptic/frame.png").astype(int)
    segments = picture[..., 0] + 256 * picture[..., 1] + 65536 * picture[..., 2]
    listed = json.load(open(f"{root}/coco/panoptic.json"))["annotations"][0]["segments_info"]
    assert set(np.unique(segments)) - {0} == {s["id"] for s in listed}
    for segment in listed:
        mask = segments == segment["id"]
        assert segment["area"] == mask.sum()
        assert {COCO[n] for n in names[mask]} == {segment["category_id"]}
    assert (np.isin(names, ["pole", "polegroup"]) == (segments == 0)).all()


def kitti():
    calibration = dict(line.split(":") for line in open(f"{root}/kitti/calib/frame.txt"))
    camera = np.array(calibration["P2"].split(), float).reshape(3, 4)
    for line in open(f"{root}/kitti/label_2/frame.txt"):
        values = line.split()
        left, top, right, bottom, h, w, l, x, y, at, turn = map(float, values[4:])
        # As the devkit draws boxes: x along the length, y down from the bottom.
        corners = np.array([[sx * l / 2, -sy * h, sz * w / 2] for sx in (-1, 1) for sy in (0, 1) for sz in (-1, 1)])
        c, s = np.cos(turn), np.sin(turn)
        corners = corners @ np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]).T + [x, y, at]
        seen = camera @ np.c_[corners, np.ones(8)].T
        u, v = seen[:2] / seen[2]
        # The objects are boxes, so that their corners span what they cover; cut at the picture's edges, 2 decimals.
        expected = [max(u.min(), 0), max(v.min(), 0), min(u.max(), width - 1), min(v.max(), height - 1)]
        assert np.abs(np.array([left, top, right, bottom]) - expected).max() < 0.02, (line, expected)
    pose = np.loadtxt(f"{root}/kitti/poses.txt").reshape(3, 4)
    assert np.allclose(pose, np.eye(4)[:3])


def png16(path):
    """A PNG of 16 bits and three channels, of which PIL keeps 8."""
    import zlib
    png = open(path, "rb").read()
    at, packed = 8, b""
    while at < len(png):
        size, kind = struct.unpack(">I4s", png[at:at + 8])
        if kind == b"IHDR":
            assert struct.unpack(">IIBB", png[at + 8:at + 18]) == (width, height, 16, 2)
        if kind == b"IDAT":
            packed += png[at + 8:at + 8 + size]
        at += 12 + size
    raw = bytearray(zlib.decompress(packed))
    stride, rows = 6 * width, []
    for r in range(height):
        kind, row = raw[r * (stride + 1)], raw[r * (stride + 1) + 1:(r + 1) * (stride + 1)]
        above = rows[-1] if rows else bytearray(stride)
        for i in range(stride):
            a, b, c = (row[i - 6] if i >= 6 else 0), above[i], (above[i - 6] if i >= 6 else 0)
            p = a + b - c
            paeth = min((a, b, c), key=lambda n: abs(p - n))
            row[i] = (row[i] + (0, a, b, (a + b) // 2, paeth)[kind]) & 255
        rows.append(row)
    return np.frombuffer(b"".join(rows), ">u2").reshape(height, width, 3).astype(float)


def flow():
    for direction in ("fwd", "bwd"):
        occlusion, u, v = (plane(f"flow_{direction}.{c}", "<f4") for c in ("occlusion", "U", "V"))
        data = open(f"{root}/flo/flow/frame_{direction}.flo", "rb").read()
        assert struct.unpack("<f2i", data[:12]) == (202021.25, width, height)
        pairs = np.frombuffer(data, "<f4", offset=12).reshape(height, width, 2)
        known = occlusion != 3
        assert (pairs[known][:, 0] == u[known]).all() and (pairs[known][:, 1] == v[known]).all()
        assert (np.abs(pairs[~known]) > 1e9).all()
    # KITTI's is forward: all whose place in the next frame is known, and those seen there.
    occlusion, u, v = (plane(f"flow_fwd.{c}", "<f4") for c in ("occlusion", "U", "V"))
    for folder, expected in (("flow_occ", occlusion != 3), ("flow_noc", occlusion == 0)):
        values = png16(f"{root}/kitti/{folder}/frame.png")
        valid = values[..., 2] == 1
        assert (valid == expected).all()
        assert np.abs((values[..., 0] - 2**15) / 64 - u)[valid].max() <= 1 / 128 + 1e-6
        assert np.abs((values[..., 1] - 2**15) / 64 - v)[valid].max() <= 1 / 128 + 1e-6


def murmur(text):
    """MurmurHash3_x86_32 of seed 0, after Appleby's reference."""
    data, h, mask = text.encode(), 0, 0xffffffff

    def mix(k):
        k = k * 0xcc9e2d51 & mask
        return ((k << 15 | k >> 17) & mask) * 0x1b873593 & mask

    whole = len(data) // 4 * 4
    for i in range(0, whole, 4):
        h ^= mix(struct.unpack("<I", data[i:i + 4])[0])
        h = ((h << 13 | h >> 19) & mask) * 5 + 0xe6546b64 & mask
    if len(data) > whole:
        h ^= mix(int.from_bytes(data[whole:], "little"))
    h ^= len(data)
    h = (h ^ h >> 16) * 0x85ebca6b & mask
    h = (h ^ h >> 13) * 0xc2b2ae35 & mask
    h ^= h >> 16
    exponent = h >> 23 & 255
    return h ^ (1 << 23) if exponent in (0, 255) else h


def exr():
    try:
        import OpenImageIO
    except ImportError:
        print("skipped: frame.exr itself; apt-get install python3-openimageio")
        return
    file = OpenImageIO.ImageInput.open(f"{root}/frame.exr")
    spec = file.spec()
    channels = list(spec.channelnames)

    def channel(name, kind="float"):
        at = channels.index(name)
        values = file.read_scanlines(0, height, 0, at, at + 1, kind)
        return np.asarray(values).reshape(shape)

    assert (channel("instance.ID", "uint") == ids).all() and (channel("Z") == z).all()
    near = np.isfinite(z)
    classes = {o["class_id"] for o in frame["objects"]} | {23}
    assert set(np.unique(channel("semantic.ID", "uint"))) <= classes
    assert (channel("semantic.ID", "uint") == mapped(CITYSCAPES, 0)).all()
    # Positions are what depth, intrinsics and pose say.
    pose, k = np.array(frame["camera"]["world_from_camera"]), np.array(frame["camera"]["intrinsics"])
    y, x = np.mgrid[0:height, 0:width] + 0.5
    way = np.stack([(x - k[0][2]) / k[0][0], -(y - k[1][2]) / k[1][1], -np.ones(shape)], -1)
    np.seterr(invalid="ignore")  # of the sky, which is infinitely far away
    world = (way * z[..., None]) @ pose[:3, :3].T + pose[:3, 3]
    position = np.stack([channel("position." + c) for c in "XYZ"], -1)
    assert np.abs(position - world)[near].max() < 1e-3 and np.isinf(position[~near]).all()
    distance = channel("distance.Y")
    assert np.abs(distance / z - np.linalg.norm(way, axis=-1))[near].max() < 1e-5
    normal = np.stack([channel("N." + c) for c in "XYZ"], -1)
    assert np.abs(np.linalg.norm(normal, axis=-1) - 1)[near].max() < 1e-5
    assert ((normal * (pose[:3, 3] - position)).sum(-1)[near] > -1e-3).all()
    # Mattes: names of the manifests have the hashes of the specification, and samples show what the centre does.
    attributes = {a.name: a.value for a in spec.extra_attribs}
    layers = {v: n.rsplit("/", 1)[0] for n, v in attributes.items() if n.startswith("cryptomatte/") and n.endswith("/name")}
    assert {"CryptoObject", "CryptoMaterial"} < set(layers) and any("Rain" in name for name in layers)
    for name, key in layers.items():
        assert key == "cryptomatte/%07x" % (murmur(name) >> 4)  # seven digits of the name's hash
        assert attributes[key + "/hash"] == "MurmurHash3_32"
        manifest = json.loads(attributes[key + "/manifest"])
        for entry, value in manifest.items():
            assert int(value, 16) == murmur(entry), entry
        first = name + "00.R"  # rank by rank: name in R and B, its share in G and A
        ranks = sorted({c[len(name):len(name) + 2] for c in channels if c.startswith(name) and c[-2] == "."})
        coverage = sum(channel(f"{name}{rank}.{c}") for rank in ranks for c in "GA")
        assert coverage.max() < 1 + 1e-5 and coverage.min() >= 0
        shown = channel(first).view("<u4")
        assert set(np.unique(shown)) <= {int(v, 16) for v in manifest.values()} | {0}
        if name == "CryptoObject":
            expected = np.zeros(shape, "<u4")
            for number, entry in objects.items():
                expected[ids == number] = murmur(entry["name"])
            assert (shown == expected).mean() > 0.9  # edges have one or the other


for check in (cityscapes, carla, coco, kitti, flow, exr):
    check()
    print(check.__name__, "reads")
