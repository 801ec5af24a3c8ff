#include "tools/learning/lpips.h"

#include <span>

namespace pluvia {
namespace {

/// place: of the convolution among torchvision's features, where activations and pools take places of their own.
struct LayerShape {
    int64_t place, out, size, stride, padding;
    bool pooled, compared;
};
constexpr LayerShape alex_layers[] = {{0, 64, 11, 4, 2, false, true},
                                      {3, 192, 5, 1, 2, true, true},
                                      {6, 384, 3, 1, 1, true, true},
                                      {8, 256, 3, 1, 1, false, true},
                                      {10, 256, 3, 1, 1, false, true}};
constexpr LayerShape vgg_layers[] = {
    {0, 64, 3, 1, 1, false, false},  {2, 64, 3, 1, 1, false, true},   {5, 128, 3, 1, 1, true, false},
    {7, 128, 3, 1, 1, false, true},  {10, 256, 3, 1, 1, true, false}, {12, 256, 3, 1, 1, false, false},
    {14, 256, 3, 1, 1, false, true}, {17, 512, 3, 1, 1, true, false}, {19, 512, 3, 1, 1, false, false},
    {21, 512, 3, 1, 1, false, true}, {24, 512, 3, 1, 1, true, false}, {26, 512, 3, 1, 1, false, false},
    {28, 512, 3, 1, 1, false, true}};

at::Tensor of_channels(float r, float g, float b, const at::Tensor& like) {
    return at::tensor({r, g, b}).reshape({1, 3, 1, 1}).to(like.device());
}

}  // namespace

Lpips::Lpips(const Parameters& p, LpipsNetwork network) : network_(network) {
    const std::span<const LayerShape> shapes = network == LpipsNetwork::alex ? std::span<const LayerShape>(alex_layers)
                                                                             : std::span<const LayerShape>(vgg_layers);
    int64_t width = 3;
    for (const LayerShape& s : shapes) {
        layers_.push_back({Convolution(p.part("features").part(s.place), width, s.out, s.size, s.stride, s.padding),
                           s.pooled, s.compared});
        width = s.out;
        if (s.compared)
            heads_.push_back(p.part("lin" + std::to_string(heads_.size()))
                                 .part("model.1")
                                 .get("weight", {1, width, 1, 1}, {Start::uniform, width}));
    }
}

std::vector<at::Tensor> Lpips::compared_features(const at::Tensor& picture) const {
    // Mean and deviation of ImageNet's pictures.
    at::Tensor h =
        (picture - of_channels(0.485f, 0.456f, 0.406f, picture)) / of_channels(0.229f, 0.224f, 0.225f, picture);
    const int64_t window = network_ == LpipsNetwork::alex ? 3 : 2;
    std::vector<at::Tensor> features;
    for (const Layer& layer : layers_) {
        if (layer.pooled) h = at::max_pool2d(h, {window, window}, {2, 2});
        h = at::relu(layer.conv(h));
        if (layer.compared) features.push_back(h / (h.square().sum(1, true).sqrt() + 1e-10));
    }
    return features;
}

double Lpips::operator()(const at::Tensor& a, const at::Tensor& b) const {
    const std::vector<at::Tensor> of_a = compared_features(a), of_b = compared_features(b);
    double sum = 0;
    for (size_t i = 0; i < of_a.size(); ++i)
        sum += ((of_a[i] - of_b[i]).square() * heads_[i]).sum(1).mean().item<double>();
    return sum;
}

}  // namespace pluvia
