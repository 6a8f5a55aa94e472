// A writer of one-line JSON: objects, arrays and values in the order they are given.

#pragma once

#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <string>

class Json
{
 public:
  const std::string &text() const { return text_; }

  Json &beginObject() { separate(); text_ += '{'; return *this; }
  Json &endObject() { text_ += '}'; return *this; }
  Json &beginArray() { separate(); text_ += '['; return *this; }
  Json &endArray() { text_ += ']'; return *this; }

  Json &key(const std::string &_name)
  {
    string(_name);
    text_ += ':';
    return *this;
  }

  Json &null() { separate(); text_ += "null"; return *this; }
  Json &boolean(bool _value) { separate(); text_ += _value ? "true" : "false"; return *this; }

  /// Numbers that JSON lacks become the strings "inf", "-inf" and "nan".
  Json &number(double _value)
  {
    separate();
    if (std::isfinite(_value))
    {
      char digits[32];
      std::snprintf(digits, sizeof digits, "%.17g", _value == 0 ? 0.0 : _value);
      text_ += digits;
    }
    else
      text_ += std::isnan(_value) ? "\"nan\"" : _value > 0 ? "\"inf\"" : "\"-inf\"";
    return *this;
  }

  Json &numbers(std::initializer_list<double> _values)
  {
    beginArray();
    for (double v : _values) number(v);
    return endArray();
  }

  Json &string(const std::string &_value)
  {
    separate();
    text_ += '"';
    for (std::size_t i = 0; i < _value.size();)
    {
      const auto c = static_cast<unsigned char>(_value[i]);
      const std::size_t length = sequenceLength(_value, i);
      char escape[16];
      if (c == '"' || c == '\\') { text_ += '\\'; text_ += static_cast<char>(c); }
      else if (c < 0x20 || length == 0)
      {
        // A byte that is no UTF-8 is shown as the Latin-1 character of that number.
        std::snprintf(escape, sizeof escape, "\\u%04x", c);
        text_ += escape;
      }
      else
        text_.append(_value, i, length);
      i += length ? length : 1;
    }
    text_ += '"';
    return *this;
  }

  /// Appends fields that another writer made without the braces around them.
  Json &fields(const std::string &_fields)
  {
    if (!_fields.empty()) { separate(); text_ += _fields; }
    return *this;
  }

 private:
  void separate()
  {
    if (text_.empty()) return;
    const char last = text_.back();
    if (last != '{' && last != '[' && last != ':') text_ += ',';
  }

  /// Length of the UTF-8 sequence at `_at`, or 0 where there is none.
  static std::size_t sequenceLength(const std::string &_s, std::size_t _at)
  {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(_s[i]); };
    const unsigned char c = byte(_at);
    const std::size_t length = c < 0x80 ? 1 : c >= 0xC2 && c < 0xE0 ? 2 : c >= 0xE0 && c < 0xF0 ? 3
                             : c >= 0xF0 && c < 0xF5 ? 4 : 0;
    if (length == 0 || _at + length > _s.size()) return 0;
    for (std::size_t i = 1; i < length; ++i)
      if ((byte(_at + i) & 0xC0) != 0x80) return 0;
    return length;
  }

  std::string text_;
};
