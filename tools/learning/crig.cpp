#include "tools/learning/crig.h"

namespace pluvia {
namespace {

/// A vector of length one; nothing is divided by less than 1e-12.
at::Tensor unit(const at::Tensor& x) {
    return x / x.norm().clamp_min(1e-12);
}

}  // namespace

CrigNet::Spectral::Spectral(const Parameters& p, int64_t in, int64_t out, int64_t size, int64_t padding_,
                            bool transposed_)
    : weight(p.get("weight_orig", transposed_ ? TensorShape{in, out, size, size} : TensorShape{out, in, size, size},
                   {Start::uniform, in * size * size})),
      u(p.get("weight_u", {out}, {Start::uniform})),
      v(p.get("weight_v", {in * size * size}, {Start::uniform})),
      padding(padding_),
      transposed(transposed_) {}

at::Tensor CrigNet::Spectral::matrix() const {
    return (transposed ? weight.transpose(0, 1) : weight).reshape({u.size(0), -1});
}

void CrigNet::Spectral::iterate() {
    const at::Tensor m = matrix();
    v = unit(at::mv(m.t(), u));
    u = unit(at::mv(m, v));
}

at::Tensor CrigNet::Spectral::operator()(const at::Tensor& x) const {
    const at::Tensor norm = at::dot(u, at::mv(matrix(), v));
    // What is linear may as well be divided afterwards, which copies no weights.
    return (transposed ? at::conv_transpose2d(x, weight) : at::conv2d(x, weight, {}, 1, padding)).div_(norm);
}

CrigNet::Gate::Gate(const Parameters& p, int64_t channels)
    : weight(p.get("weight", {channels}, {Start::one})),
      bias(p.get("bias", {channels}, {Start::zero})),
      mean(p.get("running_mean", {channels}, {Start::zero})),
      variance(p.get("running_var", {channels}, {Start::one})) {}

at::Tensor CrigNet::Gate::operator()(const at::Tensor& x, CrigMode mode) const {
    const at::Tensor normed = mode == CrigMode::training
                                  ? at::batch_norm(x, weight, bias, {}, {}, true, 0, 1e-5, false)
                                  : at::batch_norm(x, weight, bias, mean, variance, false, 0, 1e-5, false);
    return at::glu(normed, 1);
}

CrigNet::Excitation::Excitation(const Parameters& p, int64_t in, int64_t out)
    : squeeze(p.part("main").part(1), in, out, 4, 0), excite(p.part("main").part(3), out, out, 1, 0) {}

at::Tensor CrigNet::Excitation::operator()(const at::Tensor& coarse, const at::Tensor& fine) const {
    return fine * at::sigmoid(excite(at::silu(squeeze(at::adaptive_avg_pool2d(coarse, {4, 4})))));
}

CrigNet::Block CrigNet::make_block(const Parameters& p, int64_t in, int64_t out, bool two) {
    Block block;
    // Numbers are places in the published sequence, where doubling and gates take places of their own.
    int64_t place = 1;
    for (int i = 0; i < (two ? 2 : 1); ++i) {
        Spectral conv(p.part(place), i == 0 ? in : out, 2 * out, 3, 1);
        std::optional<at::Tensor> noise;
        if (two) noise = p.part(place + 1).get("weight", {1}, {Start::zero});
        const int64_t gate = place + (two ? 2 : 1);
        block.push_back({std::move(conv), noise, Gate(p.part(gate), 2 * out)});
        place = gate + 2;
    }
    return block;
}

at::Tensor CrigNet::apply(const Block& block, const at::Tensor& x, CrigMode mode, const CrigNoise& noise) {
    at::Tensor h = double_size(x);
    for (const Up& part : block) {
        h = part.conv(h);
        if (part.noise)
            if (const at::Tensor n = noise(h.size(2), h.size(3)); n.defined()) h = h + *part.noise * n;
        h = part.gate(h, mode);
    }
    return h;
}

CrigNet::CrigNet(const Parameters& p, const CrigConfig& c)
    : config_(c),
      start_(p.part("init.init").part(0), c.latent + crig_labels, 32 * c.channels, 4, 0, true),
      start_gate_(p.part("init.init").part(1), 32 * c.channels),
      blocks_{make_block(p.part("feat_8"), 16 * c.channels, 8 * c.channels, true),
              make_block(p.part("feat_16"), 8 * c.channels, 4 * c.channels, false),
              make_block(p.part("feat_32"), 4 * c.channels, 2 * c.channels, true),
              make_block(p.part("feat_64"), 2 * c.channels, 2 * c.channels, false),
              make_block(p.part("feat_128"), 2 * c.channels, c.channels, true),
              make_block(p.part("feat_256"), c.channels, c.channels / 2, false)},
      excitations_{Excitation(p.part("se_64"), 16 * c.channels, 2 * c.channels),
                   Excitation(p.part("se_128"), 8 * c.channels, c.channels),
                   Excitation(p.part("se_256"), 4 * c.channels, c.channels / 2)},
      to_64_(p.part("to_64"), 2 * c.channels, 3, 1, 0),
      to_128_(p.part("to_128"), c.channels, 3, 1, 0),
      to_picture_(p.part("to_big"), c.channels / 2, 3, 3, 1) {}

void CrigNet::iterate_norms() {
    start_.iterate();
    for (Block& block : blocks_)
        for (Up& part : block) part.conv.iterate();
    for (Excitation& e : excitations_) {
        e.squeeze.iterate();
        e.excite.iterate();
    }
    to_picture_.iterate();
}

at::Tensor CrigNet::operator()(const at::Tensor& input, CrigMode mode, const CrigNoise& noise) const {
    std::vector<at::Tensor> sizes = {start_gate_(start_(input.reshape({1, -1, 1, 1})), mode)};  // 4, 8, 16, ... pixels
    for (int i = 0; i < 6; ++i) {
        at::Tensor h = apply(blocks_[i], sizes.back(), mode, noise);
        sizes.push_back(i < 3 ? h : excitations_[i - 3](sizes[size_t(i) - 3], h));
    }
    return to_picture_(sizes.back());
}

}  // namespace pluvia
