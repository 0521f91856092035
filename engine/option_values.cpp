#include "engine/option_values.h"

#include <algorithm>

namespace tessera {

std::vector<std::string> split_list(const std::string& text) {
  std::vector<std::string> items;
  for (size_t start = 0; start <= text.size();) {
    const size_t end = std::min(text.find(',', start), text.size());
    items.emplace_back(text.substr(start, end - start));
    start = end + 1;
  }
  return items;
}

CLI::Validator number_between(float low, float high) {
  return CLI::Validator(
      [low, high](std::string& text) -> std::string {
        float value = 0;
        if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high) return "";
        return fmt::format("'{}': expected a number from {} to {}", text, low, high);
      },
      fmt::format("[{} - {}]", low, high));
}

CLI::Validator number_above_0(double high) {
  return CLI::Validator(
      [high](std::string& text) -> std::string {
        double value = 0;
        if (CLI::detail::lexical_cast(text, value) && value > 0 && value <= high) return "";
        return fmt::format("'{}': expected a number above 0 and up to {}", text, high);
      },
      fmt::format("(0 - {}]", high));
}

std::vector<double> positive_numbers(const char* option, const std::string& list, double high) {
  std::vector<double> numbers;
  for (const std::string& item : split_list(list)) {
    double number = 0;
    if (!CLI::detail::lexical_cast(item, number) || !(number > 0) || number > high)
      throw CLI::ValidationError(
          option, fmt::format("'{}': expected numbers above 0 and up to {}, separated by commas",
                              list, high));
    numbers.push_back(number);
  }
  return numbers;
}

std::vector<int> whole_numbers(const char* option, const std::string& list, int high) {
  std::vector<int> numbers;
  for (const std::string& item : split_list(list)) {
    int number = 0;
    if (!CLI::detail::lexical_cast(item, number) || number < 1 || number > high)
      throw CLI::ValidationError(
          option, fmt::format("'{}': expected whole numbers from 1 to {}, separated by commas",
                              list, high));
    numbers.push_back(number);
  }
  return numbers;
}

}  // namespace tessera
