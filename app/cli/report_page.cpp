#include "cli/report_page.h"

#include <cstdio>
#include <string_view>

#include "film/display.h"
#include "film/image_formats.h"

namespace glimt {
namespace {

constexpr const char* style =
    "body{margin:0;background:#fff;color:#222;font:16px/1.5 Georgia,serif}"
    "main{max-width:60rem;margin:0 auto;padding:2rem 1rem}"
    "h1,h2,table,figcaption,caption{font-family:Helvetica,Arial,sans-serif}h2{margin-top:2.5em}"
    "figure{margin:1.5em 0}.row{display:flex;flex-wrap:wrap;gap:.6rem}"
    ".row div{flex:1 1 11rem;max-width:29rem;font:13px/1.35 Helvetica,Arial,sans-serif}"
    "img{width:100%;display:block;margin-bottom:.3em}svg{max-width:100%;height:auto}"
    "figcaption,caption{font-size:14px;color:#555;text-align:left;padding:.4em 0}"
    "table{border-collapse:collapse;font-size:14px;margin:1.5em 0}th,td{padding:.3em .8em;border-bottom:1px solid #ddd;"
    "text-align:right}th{border-bottom:1px solid #444}th:first-child,td:first-child{text-align:left}";

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  return result;
}

/// RFC 4648, section 4.
std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string element(const std::string& name, const std::string& content) {
  return "<" + name + ">" + content + "</" + name + ">";
}

std::string row(const char* cell, const Page::Row& texts) {
  std::string cells;
  for (const auto& text : texts) cells += element(cell, escaped(text));
  return element("tr", cells) + "\n";
}

}  // namespace

Page::Page(const std::string& title)
    : html_(
          "<!DOCTYPE html>\n<html lang='en'><head><meta charset='utf-8'><meta name='viewport' "
          "content='width=device-width'><title>" +
          escaped(title) + "</title><style>" + style + "</style></head><body><main>\n" + element("h1", escaped(title)) +
          "\n") {}

void Page::heading(const std::string& text) { html_ += element("h2", escaped(text)) + "\n"; }

void Page::paragraph(const std::string& text) { html_ += element("p", escaped(text)) + "\n"; }

void Page::figure(const std::vector<Picture>& pictures, const std::string& caption) {
  html_ += "<figure><div class='row'>\n";
  for (const Picture& picture : pictures) {
    const Image& image = picture.image;
    const std::string png = encode_png(image.width, image.height, to_srgb8(image, {}), {});
    html_ +=
        "<div><img alt='' src='data:image/png;base64," + base64(png) + "'>" + escaped(picture.caption) + "</div>\n";
  }
  html_ += "</div>" + element("figcaption", escaped(caption)) + "</figure>\n";
}

void Page::table(const Row& header, const std::vector<Row>& rows, const std::string& caption) {
  html_ += "<table>" + element("caption", escaped(caption)) + "\n" + row("th", header);
  for (const Row& texts : rows) html_ += row("td", texts);
  html_ += "</table>\n";
}

void Page::chart(const std::string& svg, const std::string& caption) {
  html_ += "<figure>" + svg + element("figcaption", escaped(caption)) + "</figure>\n";
}

std::string figure_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

}  // namespace glimt
