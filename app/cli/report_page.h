#pragma once

#include <string>
#include <vector>

#include "film/film.h"

namespace glimt {

/// One self-contained HTML page, built from top to bottom. Texts are plain; the page escapes them.
class Page {
 public:
  explicit Page(const std::string& title);

  void heading(const std::string& text);
  void paragraph(const std::string& text);
  struct Picture {
    Image image;
    std::string caption;
  };
  /// Pictures side by side, as the display shows them. The page holds their data.
  void figure(const std::vector<Picture>& pictures, const std::string& caption);
  using Row = std::vector<std::string>;
  void table(const Row& header, const std::vector<Row>& rows, const std::string& caption);
  void chart(const std::string& svg, const std::string& caption);

  std::string html() const { return html_ + "</main></body></html>\n"; }

 private:
  std::string html_;
};

/// Three significant digits: "0.0123", "4.5e-06".
std::string figure_text(double value);

}  // namespace glimt
