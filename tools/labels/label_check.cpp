#include "tools/labels/label_check.h"

#include "renderer/transport/label_layers.h"
#include "tools/frame_objects.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace pluvia {
namespace {

using Json = nlohmann::ordered_json;

class Check {
public:
    explicit Check(LabelFrame& frame) : frame_(frame), view_(frame.view()) {}

    LabelCheck run() {
        if (frame_.has("instance.ID")) {
            ids_ = frame_.ids("instance.ID");
            if (frame_.has("semantic.ID")) check_classes();
            check_boxes();
        }
        for (const auto& [layer, pose] :
             {std::pair{"flow_fwd", "world_from_camera_next"}, {"flow_bwd", "world_from_camera_previous"}})
            if (frame_.has(layer + std::string(".U")) && frame_.has_view(pose)) check_flow(layer, frame_.view(pose));
        return std::move(result_);
    }

private:
    void fault(const std::string& what) { result_.faults.push_back(frame_.path + ": " + what); }
    int x_of(size_t i) const { return int(i % size_t(frame_.width)); }
    int y_of(size_t i) const { return int(i / size_t(frame_.width)); }

    void check_classes() {
        const std::vector<uint32_t> semantic = frame_.ids("semantic.ID");
        const std::vector<float> z = frame_.values("Z");
        int64_t wrong = 0;
        for (size_t i = 0; i < ids_.size(); ++i) {
            const int object = frame_.object_of(ids_[i]);
            const bool is_sky = std::isinf(z[i]);
            const bool ok = is_sky ? ids_[i] == 0 && semantic[i] == uint32_t(sky_id)
                                   : object >= 0 && semantic[i] == uint32_t(frame_.objects[size_t(object)].class_id);
            if (!ok && wrong++ == 0)
                fault(fmt::format("the class at pixel {}, {} is not that of its instance (got {} and instance {})",
                                  x_of(i), y_of(i), semantic[i], ids_[i]));
            ++result_.labelled_pixels;
        }
        if (wrong > 1) fault(fmt::format("{} pixels have another class than their instance", wrong));
    }

    void check_boxes() {
        SeenObjects seen;
        seen.look(ids_, 0, frame_.width);
        for (const FrameObject& object : frame_.objects) {
            const SeenObject* visible = seen.find(object.id);
            const int64_t pixels = visible ? visible->pixels : 0;
            if (object.json.at("visible_pixels") != pixels)
                fault(fmt::format("\"{}\" has not the pixels that are recorded (got {}, expected {})", object.name,
                                  object.json.at("visible_pixels").get<int64_t>(), pixels));
            if (!visible) continue;
            ++result_.boxes;
            if (object.json.value("box", Json()) != Json{visible->left, visible->top, visible->right, visible->bottom})
                fault(fmt::format("the box of \"{}\" does not hug it (got {}, expected {} {} {} {})", object.name,
                                  object.json.value("box", Json()).dump(), visible->left, visible->top, visible->right,
                                  visible->bottom));
            if (object.json.contains("amodal_box")) check_amodal(object, *visible);
        }
        if (std::any_of(frame_.objects.begin(), frame_.objects.end(),
                        [](const FrameObject& o) { return o.json.contains("box_3d"); }))
            check_solid_boxes();
    }

    void check_amodal(const FrameObject& object, const SeenObject& visible) {
        const Json& box = object.json.at("amodal_box");
        // A pixel counts when its centre is covered, so the box of pixels may be half a pixel larger.
        const bool holds = box.at(0) <= visible.left + 0.51 && box.at(1) <= visible.top + 0.51 &&
                           box.at(2) >= visible.right - 0.51 && box.at(3) >= visible.bottom - 0.51;
        if (!holds)
            fault(
                fmt::format("the amodal box of \"{}\" does not hold what is seen of it (got {}, expected at least "
                            "{} {} {} {})",
                            object.name, box.dump(), visible.left, visible.top, visible.right, visible.bottom));
        const double fraction = object.json.at("visible_fraction");
        const double expected =
            std::min(1.0, double(visible.pixels) / std::max(1.0, object.json.at("amodal_pixels").get<double>()));
        if (!(std::abs(fraction - expected) <= 1e-9))
            fault(fmt::format("the visible fraction of \"{}\" is not that of its pixels (got {}, expected {})",
                              object.name, fraction, expected));
    }

    void check_solid_boxes() {
        const std::vector<float> z = frame_.values("Z");
        std::vector<bool> failed(frame_.objects.size());
        for (size_t i = 0; i < ids_.size(); ++i) {
            const int index = frame_.object_of(ids_[i]);
            if (index < 0 || std::isinf(z[i])) continue;
            const FrameObject& object = frame_.objects[size_t(index)];
            if (failed[size_t(index)] || !object.json.contains("box_3d")) continue;
            const Json& box = object.json.at("box_3d");
            const auto vector = [](const Json& j) { return Vec3d(j.at(0), j.at(1), j.at(2)); };
            const Vec3d from_centre = point(i, z[i]) - vector(box.at("center")), size = vector(box.at("size"));
            const double slack = 1e-3 + 1e-4 * z[i];  // depth is single precision
            for (size_t k = 0; k < 3; ++k)
                if (std::abs(dot(from_centre, vector(box.at("axes").at(k)))) > size[int(k)] / 2 + slack)
                    failed[size_t(index)] = true;
            if (failed[size_t(index)])
                fault(fmt::format("the 3D box of \"{}\" does not hold the point that pixel {}, {} shows", object.name,
                                  x_of(i), y_of(i)));
        }
    }

    Vec3d point(size_t i, float z) const {
        const Vec3 seen = view_.view_direction({float(x_of(i)) + 0.5f, float(y_of(i)) + 0.5f});
        return view_.position + view_.world_vector_from_view(Vec3d(seen) * double(z));
    }

    /// Rows of matrices as frame.json has them: where the parts of an object go.
    struct Motion {
        double m[12];
        Vec3d operator()(Vec3d p) const {
            const auto row = [&](int r) {
                return m[4 * r] * p.x + m[4 * r + 1] * p.y + m[4 * r + 2] * p.z + m[4 * r + 3];
            };
            return {row(0), row(1), row(2)};
        }
    };
    /// Per object; empty for what rests, and for what bends.
    std::vector<std::vector<Motion>> motions(const std::string& key) const {
        std::vector<std::vector<Motion>> list(frame_.objects.size());
        for (size_t i = 0; i < list.size(); ++i) {
            if (!frame_.objects[i].json.contains(key)) continue;
            for (const Json& part : frame_.objects[i].json.at(key)) {
                Motion& motion = list[i].emplace_back();
                for (size_t k = 0; k < 12; ++k) motion.m[k] = part.at(k).get<double>();
            }
        }
        return list;
    }

    void check_flow(const std::string& layer, const View& other) {
        const std::vector<float> z = frame_.values("Z"), u = frame_.values(layer + ".U"),
                                 v = frame_.values(layer + ".V"), occlusion = frame_.values(layer + ".occlusion");
        const auto moved = motions(layer == "flow_fwd" ? "motion_next" : "motion_previous");
        // Without ids it is not known of which pixels the things move.
        const bool unknown = ids_.empty() && frame_.json.value("things_move", false);
        int64_t wrong = 0;
        for (size_t i = 0; i < z.size(); ++i) {
            if (std::isinf(z[i]) || occlusion[i] != float(FlowVisibility::visible)) continue;
            const int object = ids_.empty() ? -1 : frame_.object_of(ids_[i]);
            const bool moves = object >= 0 && frame_.objects[size_t(object)].moves;
            if (moves && moved[size_t(object)].empty()) {
                ++result_.left_out_pixels;
                continue;
            }
            const Vec3d here = point(i, z[i]);
            const auto error_at = [&](Vec3d then) {
                const Vec3d there = other.view_from_world(then);
                const double s = other.focal_pixels / there.z;
                const double x = frame_.width / 2.0 + there.x * s, y = frame_.height / 2.0 - there.y * s;
                return std::hypot(x - x_of(i) - 0.5 - u[i], y - y_of(i) - 0.5 - v[i]);
            };
            // Ids do not tell a body from its legs: one of its parts must have gone there.
            double error = moves ? std::numeric_limits<double>::quiet_NaN() : error_at(here);
            if (moves)
                for (const Motion& motion : moved[size_t(object)]) error = std::fmin(error, error_at(motion(here)));
            if (unknown && !(error < flow_tolerance)) {
                ++result_.left_out_pixels;
                continue;
            }
            ++result_.flow_pixels, result_.moving_pixels += moves;
            if (!(error <= result_.largest_flow_error)) result_.largest_flow_error = error;  // NaN stays
            if (!(error < flow_tolerance) && wrong++ == 0)
                fault(
                    fmt::format("{} at pixel {}, {} does not agree with depth and poses (off by {:.3g} pixels, "
                                "expected below {})",
                                layer, x_of(i), y_of(i), error, flow_tolerance));
        }
        if (wrong > 1) fault(fmt::format("{} pixels of {} do not agree with depth and poses", wrong, layer));
    }

    LabelFrame& frame_;
    View view_;
    std::vector<uint32_t> ids_;
    LabelCheck result_;
};

}  // namespace

LabelCheck check_labels(LabelFrame& frame) {
    return Check(frame).run();
}

}  // namespace pluvia
