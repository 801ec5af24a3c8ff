#!/usr/bin/env python3
"""Writes scores.safetensors: LPIPS and features of FID by random weights, computed by plain PyTorch.

    apt-get install python3-torch && python3 tests/learning/scores_fixture.py tests/learning/scores.safetensors

The networks are written here from their descriptions (Krizhevsky 2014; Simonyan and Zisserman 2015; Zhang et al. 2018;
Szegedy et al. 2016). Weights are pure functions of their names, as in parity_fixture.py, but of a size that keeps
signals alive through many layers.
"""
import json
import math
import sys

import torch
import torch.nn.functional as F

from parity_fixture import Weights, save


def kernel(w, name, shape):
    return w.get(name, shape, reach=math.sqrt(6 / math.prod(shape[1:])))


def lpips(w, a, b, layers, pool):
    """layers: (place in the sequence, channels, size, stride, padding, pooled before, compared after)."""
    mean = torch.tensor([0.485, 0.456, 0.406]).reshape(1, 3, 1, 1)
    deviation = torch.tensor([0.229, 0.224, 0.225]).reshape(1, 3, 1, 1)
    a, b = (a - mean) / deviation, (b - mean) / deviation
    total, head = 0.0, 0
    for place, out, size, stride, padding, pooled, compared in layers:
        weight = kernel(w, f"features.{place}.weight", (out, a.shape[1], size, size))
        bias = w.get(f"features.{place}.bias", (out,), reach=1 / math.sqrt(math.prod(weight.shape[1:])))
        if pooled:
            a, b = F.max_pool2d(a, pool, 2), F.max_pool2d(b, pool, 2)
        a = F.conv2d(a, weight, bias, stride, padding).clamp_min(0)
        b = F.conv2d(b, weight, bias, stride, padding).clamp_min(0)
        if compared:
            unit_a, unit_b = (x / (torch.sqrt((x * x).sum(1, keepdim=True)) + 1e-10) for x in (a, b))
            share = kernel(w, f"lin{head}.model.1.weight", (1, out, 1, 1))
            total += F.conv2d((unit_a - unit_b) ** 2, share).mean()
            head += 1
    return total


ALEX = [(0, 64, 11, 4, 2, 0, 1), (3, 192, 5, 1, 2, 1, 1), (6, 384, 3, 1, 1, 1, 1), (8, 256, 3, 1, 1, 0, 1),
        (10, 256, 3, 1, 1, 0, 1)]
VGG = []
for place, out, pooled, compared in [(0, 64, 0, 0), (2, 64, 0, 1), (5, 128, 1, 0), (7, 128, 0, 1), (10, 256, 1, 0),
                                     (12, 256, 0, 0), (14, 256, 0, 1), (17, 512, 1, 0), (19, 512, 0, 0),
                                     (21, 512, 0, 1), (24, 512, 1, 0), (26, 512, 0, 0), (28, 512, 0, 1)]:
    VGG.append((place, out, 3, 1, 1, pooled, compared))


class Inception:
    def __init__(self, w):
        self.w = w

    def basic(self, x, name, out, size, stride=1, padding=0):
        height, width = (size, size) if isinstance(size, int) else size
        x = F.conv2d(x, kernel(self.w, name + ".conv.weight", (out, x.shape[1], height, width)), None, stride, padding)
        mean = self.w.get(name + ".bn.running_mean", (out,))
        variance = self.w.get(name + ".bn.running_var", (out,), 1.0)
        gain, bias = self.w.get(name + ".bn.weight", (out,), 1.0), self.w.get(name + ".bn.bias", (out,))
        shape = (1, out, 1, 1)
        x = (x - mean.reshape(shape)) / torch.sqrt(variance.reshape(shape) + 0.001)
        return (x * gain.reshape(shape) + bias.reshape(shape)).clamp_min(0)

    def chain(self, x, name, *steps):
        for suffix, *rest in steps:
            x = self.basic(x, name + "." + suffix, *rest)
        return x

    def mean(self, x):
        return F.avg_pool2d(x, 3, 1, 1, count_include_pad=False)

    def a(self, x, n, pool):
        return torch.cat([
            self.chain(x, n, ("branch1x1", 64, 1)),
            self.chain(x, n, ("branch5x5_1", 48, 1), ("branch5x5_2", 64, 5, 1, 2)),
            self.chain(x, n, ("branch3x3dbl_1", 64, 1), ("branch3x3dbl_2", 96, 3, 1, 1),
                       ("branch3x3dbl_3", 96, 3, 1, 1)),
            self.chain(self.mean(x), n, ("branch_pool", pool, 1))], 1)

    def b(self, x, n):
        return torch.cat([
            self.chain(x, n, ("branch3x3", 384, 3, 2)),
            self.chain(x, n, ("branch3x3dbl_1", 64, 1), ("branch3x3dbl_2", 96, 3, 1, 1), ("branch3x3dbl_3", 96, 3, 2)),
            F.max_pool2d(x, 3, 2)], 1)

    def c(self, x, n, k):
        row, column = ((1, 7), 1, (0, 3)), ((7, 1), 1, (3, 0))
        return torch.cat([
            self.chain(x, n, ("branch1x1", 192, 1)),
            self.chain(x, n, ("branch7x7_1", k, 1), ("branch7x7_2", k, *row), ("branch7x7_3", 192, *column)),
            self.chain(x, n, ("branch7x7dbl_1", k, 1), ("branch7x7dbl_2", k, *column), ("branch7x7dbl_3", k, *row),
                       ("branch7x7dbl_4", k, *column), ("branch7x7dbl_5", 192, *row)),
            self.chain(self.mean(x), n, ("branch_pool", 192, 1))], 1)

    def d(self, x, n):
        return torch.cat([
            self.chain(x, n, ("branch3x3_1", 192, 1), ("branch3x3_2", 320, 3, 2)),
            self.chain(x, n, ("branch7x7x3_1", 192, 1), ("branch7x7x3_2", 192, (1, 7), 1, (0, 3)),
                       ("branch7x7x3_3", 192, (7, 1), 1, (3, 0)), ("branch7x7x3_4", 192, 3, 2)),
            F.max_pool2d(x, 3, 2)], 1)

    def e(self, x, n, pooled):
        three = self.chain(x, n, ("branch3x3_1", 384, 1))
        twice = self.chain(x, n, ("branch3x3dbl_1", 448, 1), ("branch3x3dbl_2", 384, 3, 1, 1))
        row, column = (384, (1, 3), 1, (0, 1)), (384, (3, 1), 1, (1, 0))
        return torch.cat([
            self.chain(x, n, ("branch1x1", 320, 1)),
            self.chain(three, n, ("branch3x3_2a", *row)), self.chain(three, n, ("branch3x3_2b", *column)),
            self.chain(twice, n, ("branch3x3dbl_3a", *row)), self.chain(twice, n, ("branch3x3dbl_3b", *column)),
            self.chain(pooled, n, ("branch_pool", 192, 1))], 1)

    def features(self, x):
        x = F.interpolate(x, size=(299, 299), mode="bilinear", align_corners=False) * 2 - 1
        x = self.basic(x, "Conv2d_1a_3x3", 32, 3, 2)
        x = self.basic(x, "Conv2d_2a_3x3", 32, 3)
        x = F.max_pool2d(self.basic(x, "Conv2d_2b_3x3", 64, 3, 1, 1), 3, 2)
        x = self.basic(x, "Conv2d_3b_1x1", 80, 1)
        x = F.max_pool2d(self.basic(x, "Conv2d_4a_3x3", 192, 3), 3, 2)
        for name, pool in (("Mixed_5b", 32), ("Mixed_5c", 64), ("Mixed_5d", 64)):
            x = self.a(x, name, pool)
        x = self.b(x, "Mixed_6a")
        for name, k in (("Mixed_6b", 128), ("Mixed_6c", 160), ("Mixed_6d", 160), ("Mixed_6e", 192)):
            x = self.c(x, name, k)
        x = self.d(x, "Mixed_7a")
        x = self.e(x, "Mixed_7b", self.mean(x))
        x = self.e(x, "Mixed_7c", F.max_pool2d(x, 3, 1, 1))
        return x.mean((2, 3))[0]


def main(path):
    torch.set_grad_enabled(False)
    generator = torch.Generator().manual_seed(21)
    a = torch.rand(1, 3, 48, 40, generator=generator)
    b = (a + 0.3 * torch.rand(a.shape, generator=generator)).clamp(0, 1)
    out, keys = {"a": a, "b": b}, {}
    for name, layers, pool in (("alex", ALEX, 3), ("vgg", VGG, 2)):
        w = Weights(23)
        out[name] = lpips(w, a, b, layers, pool).reshape(1)
        keys[name] = json.dumps(w.shapes)
        print(name, float(out[name]))
    w = Weights(29)
    network = Inception(w)
    out["inception.a"] = network.features(a)
    out["inception.b"] = Inception(w).features(b)
    keys["inception"] = json.dumps(w.shapes)
    difference = out["inception.a"] - out["inception.b"]
    print("inception", float(out["inception.a"].std()), float(difference.abs().mean()),
          sum(math.prod(s) for n, s in w.shapes.items() if "running" not in n))
    save(path, out, keys)


if __name__ == "__main__":
    main(sys.argv[1])
