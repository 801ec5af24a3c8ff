#include "tools/html_parts.h"

#include "renderer/image/image_io.h"

#include <fmt/format.h>

namespace pluvia {

const std::string html_page_style = R"(
body{font:15px/1.45 system-ui,sans-serif;margin:24px auto;max-width:1240px;padding:0 16px;color:#222;background:#fff}
h1{font-size:20px}h2{font-size:17px;margin-top:36px}h3{font-size:14px;margin:14px 0 4px}
pre{background:#f5f5f5;padding:10px;overflow-x:auto;font-size:13px}
.pair{display:inline-block;max-width:100%}.slider{position:relative;line-height:0;touch-action:none;user-select:none}
.slider img,.map img{max-width:100%;image-rendering:auto}
.slider img{pointer-events:none}.slider .over{position:absolute;left:0;top:0;width:100%;height:100%;clip-path:inset(0 50% 0 0)}
.slider .line{position:absolute;top:0;bottom:0;left:50%;width:2px;background:#fff;box-shadow:0 0 3px #000;pointer-events:none}
.slider b{position:absolute;top:8px;font:600 13px/1 system-ui;color:#fff;text-shadow:0 0 3px #000,0 0 3px #000}
input[type=range]{width:100%;margin:6px 0 0}
.row{display:flex;flex-wrap:wrap;gap:16px}.map{flex:1 1 420px}
.note{color:#666;font-size:13px}svg{background:#fafafa;max-width:100%}
)";

// The picture on top is cut at the slider's place.
const std::string html_slider_script = R"(
for(const s of document.querySelectorAll('.slider')){const r=s.parentElement.querySelector('input');
const set=()=>{s.querySelector('.over').style.clipPath='inset(0 '+(100-r.value)+'% 0 0)';s.querySelector('.line').style.left=r.value+'%'};
r.addEventListener('input',set);
const drag=e=>{const b=s.getBoundingClientRect();r.value=100*(e.clientX-b.left)/b.width;set()};
s.addEventListener('pointerdown',e=>{s.setPointerCapture(e.pointerId);drag(e)});
s.addEventListener('pointermove',e=>{if(e.buttons)drag(e)});set()}
)";

std::string html_escaped(const std::string& text) {
    std::string result;
    for (const char c : text) switch (c) {
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '&':
                result += "&amp;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += c;
        }
    return result;
}

namespace {

std::string base64(const std::vector<std::byte>& bytes) {
    constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve(bytes.size() * 4 / 3 + 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        const size_t left = bytes.size() - i;
        const auto at = [&](size_t k) { return k < left ? unsigned(bytes[i + k]) : 0u; };
        const unsigned word = at(0) << 16 | at(1) << 8 | at(2);
        text += digits[word >> 18];
        text += digits[word >> 12 & 63];
        text += left > 1 ? digits[word >> 6 & 63] : '=';
        text += left > 2 ? digits[word & 63] : '=';
    }
    return text;
}

}  // namespace

std::string png_url(const Image<Rgba8>& image) {
    return "data:image/png;base64," + base64(encode_png(image));
}

std::string jpeg_url(const Image<Rgba8>& image, int quality) {
    return "data:image/jpeg;base64," + base64(encode_jpeg(image, quality));
}

std::string html_slider(const LabelledUrl& left, const LabelledUrl& right) {
    return fmt::format(
        "<div class=\"pair\"><div class=\"slider\"><img alt=\"{0}\" src=\"{1}\"><img alt=\"{2}\" class=\"over\" "
        "src=\"{3}\"><span class=\"line\"></span><b style=\"left:8px\">{2}</b><b style=\"right:8px\">{0}</b></div>"
        "<input type=\"range\" min=\"0\" max=\"100\" step=\"0.1\" value=\"50\" aria-label=\"{2} to the left, {0} to "
        "the right\"></div>",
        html_escaped(right.label), right.url, html_escaped(left.label), left.url);
}

}  // namespace pluvia
