// Reports as `rigel report` fills them, made up: the figures of the rigs have the sizes measured on real objects.
#pragma once

#include "report/report_data.h"

namespace rigel::tests {

/// A moving car (two seconds, pictures of seven frames, the fourth in full) and a still figure in a second scene, eight rigs each.
tools::Report madeUpReport();

/// Three cars that share a frame's time under two kinds of rig; the third gives nothing up.
tools::Report crowdReport();

/// One still object with one rig, no lights, no pictures.
tools::Report smallestReport();

/// madeUpReport() with names that try to leave their place: markup, quotes, escapes, control characters, bytes that are
/// no UTF-8.
tools::Report hostileReport();

/// Names of hostileReport(), as they must read on the page and in report.json.
inline constexpr const char* kHostileMarkup = "</script><script>document.title='hacked'</script><!--<script>";
inline constexpr const char* kHostileSpec = "constant<b>&amp;";
inline constexpr const char* kHostileQuotes = "\"';--><img src=x onerror=\"document.title='hacked'\">{{DATA}}";

}  // namespace rigel::tests
