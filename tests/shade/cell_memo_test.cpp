// Many threads asking one memo for the same cells.

#include <catch2/catch.hpp>

#include <algorithm>
#include <atomic>
#include <random>
#include <thread>

#include "base/error.h"
#include "shade/cell_memo.h"

using namespace tessera;

namespace {

/// What a cell is worth.
std::array<float, 2> value_of(uint64_t key) { return {float(key) + 0.5f, -2.0f * float(key)}; }

constexpr uint64_t cells = 997;

std::vector<uint64_t> keys_of(int bucket) {
  std::mt19937 random{uint32_t(bucket)};
  std::vector<uint64_t> keys(cells);
  for (uint64_t k = 0; k < cells; ++k) keys[k] = k;
  std::ranges::shuffle(keys, random);
  keys.resize(400);
  return keys;
}

/// A bucket's part in a memo, as lattice shading plays it. Returns how many values were wrong.
size_t ask(CellMemo& memo, int bucket, std::vector<std::atomic<int>>& shaded) {
  const std::vector<uint64_t> keys = keys_of(bucket);
  std::vector<uint32_t> slots, mine;
  memo.claim(keys, slots, mine);
  std::vector<float> values(2 * keys.size(), -1.0f);
  for (const uint32_t k : mine) {
    ++shaded[keys[k]];
    const auto value = value_of(keys[k]);
    values[2 * k] = value[0], values[2 * k + 1] = value[1];
  }
  std::this_thread::yield();
  memo.publish(slots, mine, values);
  std::ranges::fill(values, -1.0f);
  memo.read(slots, values);
  size_t wrong = 0;
  for (size_t k = 0; k < keys.size(); ++k) {
    const auto value = value_of(keys[k]);
    wrong += values[2 * k] != value[0] || values[2 * k + 1] != value[1];
  }
  return wrong;
}

}  // namespace

TEST_CASE("threads that ask for the same cells shade each once and read the same") {
  for (int round = 0; round < 20; ++round) {
    CellMemo memo(2);
    std::vector<std::atomic<int>> shaded(cells);
    std::atomic<size_t> wrong = 0;
    std::vector<std::thread> threads;
    for (int t = 0; t < 8; ++t)
      threads.emplace_back([&, t] {
        for (int k = 0; k < 4; ++k) wrong += ask(memo, 100 * round + 4 * t + k, shaded);
      });
    for (std::thread& thread : threads) thread.join();
    CHECK(wrong == 0);
    std::vector<bool> asked(cells, false);
    for (int bucket = 0; bucket < 32; ++bucket)
      for (const uint64_t key : keys_of(100 * round + bucket)) asked[key] = true;
    size_t not_once = 0;
    for (uint64_t k = 0; k < cells; ++k) not_once += shaded[k] != int(asked[k]);
    CHECK(not_once == 0);
  }
}

TEST_CASE("a claim names the new cells only, each at its first place") {
  CellMemo memo(1);
  std::vector<uint32_t> slots, mine;
  const uint64_t first[] = {5, 6, 7}, second[] = {7, 8, 5, 9};
  memo.claim(first, slots, mine);
  CHECK(mine == std::vector<uint32_t>{0, 1, 2});
  const std::vector<uint32_t> of_first = slots;
  memo.claim(second, slots, mine);
  CHECK(mine == std::vector<uint32_t>{1, 3});
  CHECK(slots[0] == of_first[2]);
  CHECK(slots[2] == of_first[0]);
  CHECK(slots[1] != slots[3]);
}

TEST_CASE("when a claim is given up, all who wait for it get the reason, and nobody hangs") {
  CellMemo memo(1);
  std::vector<uint32_t> slots, mine;
  const uint64_t keys[] = {1, 2};
  memo.claim(keys, slots, mine);
  const float one[] = {41, 0};
  const uint32_t published[] = {0};
  memo.publish(slots, published, one);

  std::atomic<int> threw = 0, claimed = 0;
  std::vector<std::thread> waiters;
  for (int t = 0; t < 6; ++t)
    waiters.emplace_back([&] {
      std::vector<uint32_t> my_slots, my_mine;
      memo.claim(keys, my_slots, my_mine);
      claimed += int(my_mine.size());
      float values[2];
      try {
        memo.read(my_slots, values);
      } catch (const Error& error) {
        threw += std::string(error.what()) == "no such texture";
      }
    });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  memo.give_up(std::make_exception_ptr(Error("no such texture")));
  for (std::thread& waiter : waiters) waiter.join();
  CHECK(threw == 6);
  CHECK(claimed == 0);
  // What had been published before stays good.
  float value[1];
  memo.read(std::span(slots).first(1), value);
  CHECK(value[0] == 41);
}
