// The fixed parts of a dataset's report: style and script of the page. Its data are written by report.cpp.
#pragma once

namespace pluvia {

extern const char* const report_style;
extern const char* const report_body;
/// Expects DATA, an object with frames, and bind(), which makes new sliders move.
extern const char* const report_script;

}  // namespace pluvia
