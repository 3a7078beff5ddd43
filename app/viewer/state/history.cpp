#include "viewer/state/history.h"

#include <utility>

namespace glimt {
namespace {

constexpr std::size_t most_steps = 1000;

}  // namespace

void History::edited(Document before, std::uint64_t gesture) {
  const bool goes_on = gesture != 0 && gesture == gesture_ && !undo_.empty();
  gesture_ = gesture;
  redo_.clear();
  if (goes_on) return;
  undo_.push_back(std::move(before));
  if (undo_.size() > most_steps) undo_.erase(undo_.begin());
}

std::optional<Document> History::move(std::vector<Document>& from, std::vector<Document>& to, Document now) {
  if (from.empty()) return std::nullopt;
  gesture_ = 0;
  to.push_back(std::move(now));
  Document there = std::move(from.back());
  from.pop_back();
  return there;
}

}  // namespace glimt
