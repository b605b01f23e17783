#include <string_view>

#include "report_json.h"

namespace ssphh::report {

// The files of libs/report/page, kept in the library at build time.
extern const std::string_view page_html, page_style, page_script;

namespace {

// Inside a script element only "</script" and "<!--" have a meaning.
std::string script_safe(const std::string& json) {
  std::string safe;
  for (const char c : json) safe += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return safe;
}

std::string html_text(const std::string& text) {
  std::string safe;
  for (const char c : text)
    safe += c == '<' ? std::string("&lt;") : c == '&' ? std::string("&amp;") : std::string(1, c);
  return safe;
}

// Adds UTF-8 text; what is not UTF-8 becomes U+FFFD.
void append(std::u16string& out, std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t k) {
      return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0u;
    };
    const std::uint32_t first = byte(0);
    const std::size_t length = first < 0x80       ? 1
                               : first >> 5 == 6  ? 2
                               : first >> 4 == 14 ? 3
                               : first >> 3 == 30 ? 4
                                                  : 0;
    std::uint32_t code = length == 1 ? first : first & (0x7fu >> length);
    bool good = length > 0;
    for (std::size_t k = 1; k < length; ++k) {
      good = good && byte(k) >> 6 == 2;
      code = code << 6 | (byte(k) & 63u);
    }
    if (!good) code = 0xfffd;
    if (code >= 0x10000) {
      out += static_cast<char16_t>(0xd800 + ((code - 0x10000) >> 10));
      code = 0xdc00 + (code & 0x3ff);
    }
    out += static_cast<char16_t>(code);
    i += good ? length : 1;
  }
}

// UTF-16, little endian; its byte order mark decides the encoding whatever a server says.
std::string encoded(const std::u16string& page) {
  std::string bytes;
  bytes.reserve(2 * page.size() + 2);
  const auto put = [&](char16_t c) {
    bytes += static_cast<char>(c & 255), bytes += static_cast<char>(c >> 8);
  };
  put(0xfeff);
  for (const char16_t c : page) put(c);
  return bytes;
}

}  // namespace

std::string report_page(const Report& report) {
  json::Value data = json_of(report);
  std::u16string blobs;
  int count = 0;
  for (std::size_t i = 0; i < report.cells.size(); ++i) {
    json::Value pictures = json::Value::array();
    for (const CellPicture& picture : report.cells[i].pictures) {
      const std::string id = "blob" + std::to_string(count++);
      pictures.push_back({{"id", id},
                          {"layer", picture.layer},
                          {"map", picture.map},
                          {"kind", picture.packed.kind},
                          {"width", picture.packed.width},
                          {"height", picture.packed.height},
                          {"channels", picture.packed.channels},
                          {"bytes", picture.packed.bytes.size()}});
      append(blobs, "<script type=\"text/plain\" id=\"" + id + "\">");
      blobs += base32768(picture.packed.bytes);
      append(blobs, "</script>\n");
    }
    data["cells"][i]["pictures"] = std::move(pictures);
  }
  const std::string safe = script_safe(json::print(data, -1, json::Letters::ascii));
  std::u16string page;
  page.reserve(blobs.size() + safe.size() + (std::size_t{1} << 17));
  const std::string_view html = page_html;
  for (std::size_t i = 0; i < html.size();) {
    const std::size_t open = html.find("%%", i);
    append(page, html.substr(i, open - i));
    if (open == std::string_view::npos) break;
    const std::size_t close = html.find("%%", open + 2);
    const std::string_view name = html.substr(open + 2, close - open - 2);
    if (name == "title") append(page, html_text(report.plan.title));
    if (name == "style") append(page, page_style);
    if (name == "data") append(page, safe);
    if (name == "blobs") page += blobs;
    if (name == "script") append(page, page_script);
    i = close + 2;
  }
  return encoded(page);
}

}  // namespace ssphh::report
