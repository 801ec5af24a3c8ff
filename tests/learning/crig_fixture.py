#!/usr/bin/env python3
"""Writes crig.safetensors: pictures of a small CRIGNet generator, computed by plain PyTorch.

    apt-get install python3-torch && python3 tests/learning/crig_fixture.py tests/learning/crig.safetensors

The generator is written here from its published description (Liu et al. 2021, FastGAN, with a latent and a label in),
as functions of a dictionary of tensors. Weights and noise are pure functions of their names, as in parity_fixture.py.
"""
import json
import math
import sys

import torch
import torch.nn.functional as F

from parity_fixture import Weights, save

LATENT, CHANNELS, SIDE = 6, 8, 256


def unit(x):
    return x / max(float(x.norm()), 1e-12)


class Network:
    """norms: steps of the power iteration before the picture. stored: normalise with stored statistics."""

    def __init__(self, weights, norms, stored, noisy):
        self.w, self.norms, self.stored, self.noisy = weights, norms, stored, noisy
        self.asked = 0

    def spectral_weight(self, name, shape, out_axis):
        fan = math.prod(shape) // shape[out_axis] if out_axis == 0 else shape[0] * math.prod(shape[2:])
        weight = self.w.get(name + ".weight_orig", shape, reach=1 / math.sqrt(fan))
        matrix = weight.transpose(0, out_axis).reshape(shape[out_axis], -1)
        u = self.w.get(name + ".weight_u", (matrix.shape[0],), reach=1.0)
        v = self.w.get(name + ".weight_v", (matrix.shape[1],), reach=1.0)
        for _ in range(self.norms):
            v = unit(matrix.t() @ u)
            u = unit(matrix @ v)
        return weight / (u @ (matrix @ v))

    def conv(self, x, name, out, size, padding=0):
        return F.conv2d(x, self.spectral_weight(name, (out, x.shape[1], size, size), 0), padding=padding)

    def gate(self, x, name):
        c = x.shape[1]
        weight, bias = self.w.get(name + ".weight", (c,), 1.0), self.w.get(name + ".bias", (c,))
        mean, variance = self.w.get(name + ".running_mean", (c,)), self.w.get(name + ".running_var", (c,), 1.0)
        if not self.stored:
            mean, variance = x.mean((0, 2, 3)), x.var((0, 2, 3), unbiased=False)
        shape = (1, c, 1, 1)
        h = (x - mean.reshape(shape)) / torch.sqrt(variance.reshape(shape) + 1e-5)
        h = h * weight.reshape(shape) + bias.reshape(shape)
        return h[:, :c // 2] * torch.sigmoid(h[:, c // 2:])

    def noise(self, x, name):
        strength = self.w.get(name + ".weight", (1,))
        if not self.noisy:
            return x
        _, _, height, width = x.shape
        hidden = Weights(self.w.seed)  # so that noise is not listed among the network's keys
        values = hidden.get(f"noise.{self.asked}", (1, 1, height, width), reach=1.0)
        self.asked += 1
        return x + strength * values

    def up(self, x, name, out, two):
        h = self.conv(F.interpolate(x, scale_factor=2, mode="nearest"), name + ".1", 2 * out, 3, 1)
        if not two:
            return self.gate(h, name + ".2")
        h = self.gate(self.noise(h, name + ".2"), name + ".3")
        h = self.conv(h, name + ".5", 2 * out, 3, 1)
        return self.gate(self.noise(h, name + ".6"), name + ".7")

    def excite(self, coarse, fine, name):
        c = fine.shape[1]
        h = self.conv(F.adaptive_avg_pool2d(coarse, 4), name + ".main.1", c, 4)
        return fine * torch.sigmoid(self.conv(h * torch.sigmoid(h), name + ".main.3", c, 1))

    def picture(self, latent_and_label):
        n = CHANNELS
        x = latent_and_label.reshape(1, -1, 1, 1)
        weight = self.spectral_weight("init.init.0", (x.shape[1], 32 * n, 4, 4), 1)
        f4 = self.gate(F.conv_transpose2d(x, weight), "init.init.1")
        f8 = self.up(f4, "feat_8", 8 * n, True)
        f16 = self.up(f8, "feat_16", 4 * n, False)
        f32 = self.up(f16, "feat_32", 2 * n, True)
        f64 = self.excite(f4, self.up(f32, "feat_64", 2 * n, False), "se_64")
        f128 = self.excite(f8, self.up(f64, "feat_128", n, True), "se_128")
        f256 = self.excite(f16, self.up(f128, "feat_256", n // 2, False), "se_256")
        for name, features in (("to_64", f64), ("to_128", f128)):  # in the checkpoint, but of no use at this size
            self.spectral_weight(name, (3, features.shape[1], 1, 1), 0)
        return self.conv(f256, "to_big", 3, 3, 1)


def main(path):
    torch.set_grad_enabled(False)
    generator = torch.Generator().manual_seed(9)
    x = torch.randn(1, LATENT + 2, generator=generator)
    weights = Weights(17)
    out = {"input": x}
    for name, norms, stored, noisy in (("training", 1, False, True), ("evaluation", 20, True, True),
                                       ("quiet", 2, False, False)):
        picture = Network(weights, norms, stored, noisy).picture(x)
        assert picture.shape == (1, 3, SIDE, SIDE)
        out[name] = picture[:, :, ::5, ::7].contiguous()
        print(name, float(picture.min()), float(picture.max()), float(picture.std()))
    # What the published script draws first from its seed: label, then latent.
    torch.manual_seed(123)
    out["seed.label"] = torch.rand(1, 2) * 2 - 1
    out["seed.latent"] = torch.randn(1, 128)
    save(path, out, {"keys": json.dumps(weights.shapes)})


if __name__ == "__main__":
    main(sys.argv[1])
