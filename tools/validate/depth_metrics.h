// How well depth and masks agree: a is judged, b is the truth.
#pragma once

#include "renderer/image/image.h"

namespace pluvia {

/// Over the pixels where b has a depth: finite and above zero. NaN without any.
struct DepthErrors {
    double abs_rel = 0;           // mean |a - b| / b
    double rmse = 0;              // root of the mean (a - b)^2, metres
    double delta[3] = {0, 0, 0};  // share with max(a / b, b / a) < 1.25, 1.25^2, 1.25^3; where a has no depth: missed
    double missing = 0;           // share where a has no depth; left out of abs_rel and rmse
};
/// Source: Eigen, Puhrsch and Fergus 2014.
DepthErrors depth_errors(const Image<float>& a, const Image<float>& b);

/// Of pixels that are set, which is from one half on. An empty a finds all of an empty b: 1 for all three; otherwise
/// precision is 0 for an empty a and recall 0 for an empty b.
struct MaskAgreement {
    double iou = 0;        // set in both / set in either
    double precision = 0;  // set in both / set in a
    double recall = 0;     // set in both / set in b
};
MaskAgreement mask_agreement(const Image<float>& a, const Image<float>& b);

}  // namespace pluvia
