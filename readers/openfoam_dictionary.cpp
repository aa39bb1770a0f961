// SPDX-License-Identifier: BSD-3-Clause
#include "readers/openfoam_dictionary.hpp"

#include <algorithm>
#include <filesystem>

#include "readers/numbers.hpp"
#include "readers/openfoam_blocks.hpp"

namespace bedscope::readers {
namespace {

namespace fs = std::filesystem;

constexpr int deepest = 64;                     // dictionaries in dictionaries, files in files
constexpr std::size_t longest_value = 1 << 20;  // also bounds what macros can grow to

using Kind = FoamToken::Kind;

// The same for all names of a file; as it stands where the system gives none (/dev/fd/3).
std::string absolute(const std::string& path) {
  std::error_code error;
  const auto found = fs::weakly_canonical(path, error);
  return error ? path : found.string();
}

bool in_macro_name(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
         c == '.' || c == ':';
}

// $name, $sub.name, $:name and $..name, since 2019 $sub/name and $!sub/name, too, all look from the
// top of the file: scopes are few here.
const FoamDictionary::Entry* look_up(const FoamDictionary& top, std::string_view name) {
  name.remove_prefix(std::min(name.find_first_not_of(":.!/"), name.size()));
  if (const auto* entry = top.find(name)) return entry;
  const auto point = name.find_first_of("./");
  if (point == std::string_view::npos) return nullptr;
  const auto* sub = top.dictionary(name.substr(0, point));
  return sub == nullptr ? nullptr : look_up(*sub, name.substr(point + 1));
}

void expand_into(std::string& out, std::string_view text, const FoamDictionary& dictionary,
                 const std::string& where, int depth) {
  if (depth > deepest) throw FormatError("{}: macros refer to one another in a circle", where);
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] != '$') {
      out += text[i++];
    } else {
      std::size_t stop = ++i;
      const bool braced = stop < text.size() && text[stop] == '{';
      if (braced)
        stop = std::min(text.find('}', i), text.size());
      else
        while (stop < text.size() &&
               (in_macro_name(text[stop]) || (text[stop] == '!' && stop == i) ||
                (text[stop] == '/' && stop + 1 < text.size() && in_macro_name(text[stop + 1]))))
          ++stop;
      const auto name = braced ? text.substr(i + 1, stop - i - 1) : text.substr(i, stop - i);
      i = braced ? std::min(stop + 1, text.size()) : stop;
      const auto* entry = look_up(dictionary, name);
      if (entry == nullptr || !entry->nested.empty())
        throw FormatError("{}: expected a value for ${}, found none in the file{}", where, name,
                          dictionary.not_followed.empty()
                              ? ""
                              : "; not followed: " + dictionary.not_followed.front());
      expand_into(out, entry->value, dictionary, where, depth + 1);
    }
    if (out.size() > longest_value)
      throw FormatError("{}: a value of more than {} characters", where, longest_value);
  }
}

}  // namespace

const FoamDictionary::Entry* FoamDictionary::find(std::string_view name) const {
  const auto found = std::find_if(entries.rbegin(), entries.rend(),
                                  [&](const Entry& entry) { return entry.keyword == name; });
  return found == entries.rend() ? nullptr : &*found;
}

const FoamDictionary* FoamDictionary::dictionary(std::string_view name) const {
  const auto* entry = find(name);
  return entry == nullptr || entry->nested.empty() ? nullptr : &entry->nested.front();
}

std::optional<std::string> FoamDictionary::value(std::string_view name,
                                                 const std::string& where) const {
  const auto* entry = find(name);
  if (entry == nullptr || !entry->nested.empty()) return std::nullopt;
  return expand_macros(entry->value, *this, where);
}

std::string expand_macros(std::string_view text, const FoamDictionary& dictionary,
                          const std::string& where) {
  std::string out;
  expand_into(out, text, dictionary, where, 0);
  return out;
}

FoamEntries::FoamEntries(FoamStream& stream) : FoamEntries(stream, {absolute(stream.path())}) {}

FoamEntries::FoamEntries(FoamStream& stream, std::vector<std::string> chain)
    : stream_(&stream), chain_(std::move(chain)) {}

FoamToken FoamEntries::keyword(FoamDictionary& dictionary) {
  for (;;) {
    auto token = stream_->next();
    if (token.kind == Kind::directive) {
      follow(token, dictionary);
    } else if (token.kind == Kind::variable) {  // "$common;" would copy a dictionary
      dictionary.not_followed.push_back(token.text);
      stream_->take(';');
    } else if (!token.is(';')) {
      return token;
    }
  }
}

void FoamEntries::follow(const FoamToken& directive, FoamDictionary& dictionary) {
  const auto path = stream_->next();
  const bool optional = directive.text == "#includeIfPresent" || directive.text == "#sinclude";
  if ((directive.text != "#include" && !optional) || path.kind != Kind::string) {
    // An argument on its own line end or a block in braces: both are passed over.
    dictionary.not_followed.push_back(fmt::format("{} {}", directive.text, path.text));
    if (path.is('{')) {
      FoamDictionary unused;
      nested(unused, 0);
    }
    return;
  }
  const fs::path target = fs::path(stream_->path()).parent_path() / path.text;
  std::error_code ignored;  // a name that is too long is the name of no file
  // A NUL would cut the name and so name another file.
  if (fs::path(path.text).is_absolute() ||
      path.text.find_first_of(std::string_view("$<\0", 3)) != std::string::npos ||
      !fs::is_regular_file(target, ignored)) {
    if (!optional) dictionary.not_followed.push_back(fmt::format("#include \"{}\"", path.text));
    return;
  }
  auto chain = chain_;
  chain.push_back(absolute(target.string()));
  if (std::count(chain.begin(), chain.end(), chain.back()) > 1)
    stream_->fail(directive.offset, "#include of {}",
                  chain.back() == chain_.back() ? "itself" : "a file that includes this one");
  if (static_cast<int>(chain.size()) > deepest)
    stream_->fail(directive.offset, "#include of more than {} files in one another", deepest);
  FoamStream stream(target.string());
  FoamEntries included(stream, std::move(chain));  // its header may include files, too
  included.header();
  included.all(dictionary);
}

std::string FoamEntries::value_text(const FoamToken& keyword) {
  std::string text;
  std::string open;  // the brackets that are open
  for (;;) {
    const auto token = stream_->next();
    if (token.at_end())
      stream_->fail_cut("expected \";\" after the value of {}, found end of file", keyword.text);
    if (token.is(';') && open.empty()) return text;
    if (token.kind == Kind::sign) {
      const char sign = token.text[0];
      if (sign == '(' || sign == '{' || sign == '[')
        open += sign == '(' ? ')' : sign == '{' ? '}' : ']';
      if (sign == ')' || sign == '}' || sign == ']') {
        if (open.empty() || open.back() != sign)
          stream_->fail(token.offset, "expected \"{}\" in the value of {}, found \"{}\"",
                        open.empty() ? ';' : open.back(), keyword.text, sign);
        open.pop_back();
      }
    }
    if (!text.empty()) text += ' ';
    text += token.kind == Kind::string ? '"' + token.text + '"' : token.text;
    if (text.size() > longest_value)
      stream_->fail(keyword.offset, "the value of {} has more than {} characters", keyword.text,
                    longest_value);
  }
}

void FoamEntries::nested(FoamDictionary& dictionary, int depth) {
  if (depth > deepest)
    stream_->fail(stream_->offset(), "more than {} dictionaries in one another", deepest);
  for (;;) {
    const auto token = keyword(dictionary);
    if (token.at_end()) stream_->fail_cut("expected \"}}\", found end of file");
    if (token.is('}')) return;
    entry(token, dictionary, depth);
  }
}

void FoamEntries::entry(const FoamToken& token, FoamDictionary& dictionary, int depth) {
  if (token.kind == Kind::sign)
    stream_->fail(token.offset, "expected a keyword, found \"{}\"", token.text);
  FoamDictionary::Entry made{token.text, {}, {}};
  if (stream_->take('{'))
    nested(made.nested.emplace_back(), depth + 1);
  else
    made.value = value_text(token);
  dictionary.entries.push_back(std::move(made));
}

void FoamEntries::entry(const FoamToken& token, FoamDictionary& dictionary) {
  entry(token, dictionary, 0);
}

void FoamEntries::all(FoamDictionary& dictionary) {
  for (auto token = keyword(dictionary); !token.at_end(); token = keyword(dictionary))
    entry(token, dictionary);
}

FoamHeader read_header(FoamStream& stream) { return FoamEntries(stream).header(); }

FoamHeader FoamEntries::header() {
  auto& stream = *stream_;
  FoamHeader header;
  if (stream.peek() != 'F') return header;
  constexpr std::string_view name = "FoamFile";
  while (static_cast<std::size_t>(stream.end() - stream.at()) < name.size() && stream.more()) {
  }
  if (!std::string_view(stream.at(), static_cast<std::size_t>(stream.end() - stream.at()))
           .starts_with(name))
    return header;
  FoamDictionary dictionary;
  entry(stream.next(), dictionary);
  const auto* entries = dictionary.dictionary(name);
  if (entries == nullptr) stream.fail(stream.offset(), "expected \"{{\" after FoamFile");
  const auto text = [&](std::string_view key) {
    const auto* entry = entries->find(key);
    auto value = entry == nullptr ? std::string() : entry->value;
    std::erase(value, '"');
    return value;
  };
  header.present = true;
  header.class_name = text("class");
  header.note = text("note");
  header.arch = text("arch");
  const auto format = text("format");
  header.binary = format == "binary";
  if (!header.binary && format != "ascii" && !format.empty())
    stream.fail(stream.offset(), "expected format ascii or binary, found {}", format);
  return header;
}

FoamDictionary read_dictionary(const std::string& path) {
  FoamBlocks file(path);
  FoamDictionary dictionary;
  if (file.next()) FoamEntries(file.stream()).all(dictionary);
  return dictionary;
}

FoamDictionary read_named_list(FoamStream& stream) {
  FoamDictionary list;
  if (stream.peek() != '(') stream.next();  // the count: what is there counts
  stream.expect('(', "the number of entries");
  FoamEntries entries(stream);
  while (!stream.take(')')) {
    const auto name = entries.keyword(list);
    if (name.at_end()) stream.fail_cut("expected \")\", found end of file");
    entries.entry(name, list);
  }
  return list;
}

}  // namespace bedscope::readers
