#include "spirv/canonical.h"

#include <spirv-tools/libspirv.h>

#include <algorithm>
#include <memory>
#include <unordered_map>

namespace rigel::tools {
namespace {

using Words = std::vector<std::uint32_t>;

constexpr std::size_t kHeaderWords = 5, kBoundWord = 3;
constexpr std::uint16_t kOpUndef = 1, kOpTypeVoid = 19, kOpSpecConstantOp = 52, kOpName = 5, kOpMemberName = 6,
                        kOpEntryPoint = 15, kOpVariable = 59, kOpFunction = 54, kOpDecorate = 71,
                        kOpMemberDecorate = 72;

struct Instruction {
  Words words;
  std::vector<std::size_t> ids;       // words that are ids
  std::size_t interfaceBegins = ~0u;  // of an entry point
  std::uint32_t result = 0;
  std::uint16_t op() const { return static_cast<std::uint16_t>(words[0] & 0xffff); }
};

bool isId(spv_operand_type_t type) {
  return type == SPV_OPERAND_TYPE_ID || type == SPV_OPERAND_TYPE_TYPE_ID || type == SPV_OPERAND_TYPE_RESULT_ID ||
         type == SPV_OPERAND_TYPE_MEMORY_SEMANTICS_ID || type == SPV_OPERAND_TYPE_SCOPE_ID;
}

bool isDecoration(std::uint16_t op) {
  return op == kOpName || op == kOpMemberName || op == kOpDecorate || op == kOpMemberDecorate;
}

spv_result_t take(void* all, const spv_parsed_instruction_t* parsed) {
  Instruction instruction;
  instruction.words.assign(parsed->words, parsed->words + parsed->num_words);
  instruction.result = parsed->result_id;
  for (std::uint16_t i = 0; i < parsed->num_operands; ++i) {
    if (!isId(parsed->operands[i].type)) continue;
    // Model, function, name, interface.
    if (parsed->opcode == kOpEntryPoint && i >= 3)
      instruction.interfaceBegins = std::min<std::size_t>(instruction.interfaceBegins, parsed->operands[i].offset);
    instruction.ids.push_back(parsed->operands[i].offset);
  }
  static_cast<std::vector<Instruction>*>(all)->push_back(std::move(instruction));
  return SPV_SUCCESS;
}

class Renumbering {
 public:
  explicit Renumbering(std::vector<Instruction> all) : all_(std::move(all)) {}

  Words run(std::span<const std::uint32_t> header) {
    split();
    for (Instruction& instruction : functions_) number(instruction, functionWords_);
    for (Instruction& instruction : entryPoints_) nameEntryPoint(instruction);
    Words words(header.begin(), header.end());
    for (Instruction& instruction : preamble_) number(instruction, words);
    put(decorations_, words);
    words.insert(words.end(), globalWords_.begin(), globalWords_.end());
    words.insert(words.end(), functionWords_.begin(), functionWords_.end());
    words[kBoundWord] = next_;
    return words;
  }

 private:
  /// Preamble (capabilities to execution modes), decorations, globals by their id, functions.
  void split() {
    bool inFunctions = false;
    for (Instruction& instruction : all_) {
      inFunctions = inFunctions || instruction.op() == kOpFunction;
      if (inFunctions) {
        functions_.push_back(std::move(instruction));
      } else if (isDecoration(instruction.op())) {
        decorations_.push_back(std::move(instruction));
      } else if (instruction.result != 0 && isGlobal(instruction)) {
        globals_.emplace(instruction.result, std::move(instruction));
      } else {
        if (instruction.op() == kOpEntryPoint) entryPoints_.push_back(instruction);
        preamble_.push_back(std::move(instruction));
      }
    }
  }
  /// Types, constants, variables; extended instruction sets (OpExtInstImport) and strings stay where they are.
  static bool isGlobal(const Instruction& instruction) {
    const std::uint16_t op = instruction.op();
    return op == kOpUndef || op == kOpVariable || (op >= kOpTypeVoid && op <= kOpSpecConstantOp);
  }

  void number(Instruction& instruction, Words& out) {
    for (const std::size_t at : instruction.ids)
      if (at < instruction.interfaceBegins) instruction.words[at] = idOf(instruction.words[at]);
    if (instruction.interfaceBegins < instruction.words.size()) {
      const auto first = instruction.words.begin() + static_cast<std::ptrdiff_t>(instruction.interfaceBegins);
      std::for_each(first, instruction.words.end(), [&](std::uint32_t& id) { id = numbers_.at(id); });
      std::sort(first, instruction.words.end());
    }
    out.insert(out.end(), instruction.words.begin(), instruction.words.end());
  }

  /// Variables of the interface that no function needs.
  void nameEntryPoint(const Instruction& instruction) {
    for (std::size_t at = instruction.interfaceBegins; at < instruction.words.size(); ++at) idOf(instruction.words[at]);
  }

  /// The new number; what a global is made of is declared before it.
  std::uint32_t idOf(std::uint32_t old) {
    if (const auto known = numbers_.find(old); known != numbers_.end()) return known->second;
    const auto global = globals_.find(old);
    if (global == globals_.end()) return numbers_[old] = next_++;
    for (const std::size_t at : global->second.ids)
      if (global->second.words[at] != old) idOf(global->second.words[at]);
    numbers_[old] = next_++;
    number(global->second, globalWords_);
    return numbers_[old];
  }

  /// Of ids that are left, sorted.
  void put(const std::vector<Instruction>& decorations, Words& out) {
    std::vector<Words> sorted;
    for (const Instruction& instruction : decorations) {
      const auto target = numbers_.find(instruction.words[1]);
      if (target == numbers_.end()) continue;
      sorted.push_back(instruction.words);
      sorted.back()[1] = target->second;
    }
    std::ranges::sort(sorted, {}, [](const Words& words) { return Words(words.begin() + 1, words.end()); });
    for (const Words& words : sorted) out.insert(out.end(), words.begin(), words.end());
  }

  std::vector<Instruction> all_, preamble_, entryPoints_, decorations_, functions_;
  std::unordered_map<std::uint32_t, Instruction> globals_;
  std::unordered_map<std::uint32_t, std::uint32_t> numbers_;
  std::uint32_t next_ = 1;
  Words globalWords_, functionWords_;
};

}  // namespace

Result<std::vector<std::uint32_t>> canonical(std::span<const std::uint32_t> words) {
  const std::unique_ptr<spv_context_t, void (*)(spv_context)> context(spvContextCreate(SPV_ENV_VULKAN_1_1),
                                                                      spvContextDestroy);
  std::vector<Instruction> all;
  if (spvBinaryParse(context.get(), &all, words.data(), words.size(), nullptr, take, nullptr) != SPV_SUCCESS)
    return Error{"not SPIR-V", "spirv"};
  return Renumbering(std::move(all)).run(words.first(kHeaderWords));
}

}  // namespace rigel::tools
