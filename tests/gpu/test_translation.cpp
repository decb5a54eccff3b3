// The library reaches other graphics interfaces by shaders/translate: a shader that calls every function of every file,
// in all numbers of bands, with coefficients from a uniform block and from a texel buffer.
#include "gpu/gpu_test.h"
#include "lights/random.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <set>

namespace rigel::test {
namespace {

using ::testing::HasSubstr;

struct Outcome {
  int exitCode;
  std::string out, err;
};

Outcome runCommand(const std::string& command) {
  const TemporaryFolder folder;
  const int status =
      std::system((command + " >'" + (folder / "out").string() + "' 2>'" + (folder / "err").string() + "'").c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contentOf(folder / "out"), contentOf(folder / "err")};
}

Outcome translate(const std::string& arguments) { return runCommand("'" RIGEL_TRANSLATE "' " + arguments); }

enum class Coefficients { block, texels };

/// Includes every file of the library.
std::string head(Coefficients from, int bands) {
  std::string text = "#version 450\n#extension GL_GOOGLE_include_directive : require\n#define RIGEL_BANDS " +
                     std::to_string(bands) + "\n";
  if (from == Coefficients::block) {
    text +=
        "layout(std140, binding = 0) uniform Block { vec4 coefficients[512]; };\n"
        "#define RIGEL_SOURCE int\n#define RIGEL_FETCH(source, i) coefficients[source + i]\n";
  }
  text +=
      "layout(binding = 4) uniform sampler2D diskTable0;\nlayout(binding = 5) uniform sampler2D diskTable1;\n"
      "#define RIGEL_DISK_TABLE(texture, uv) \\\n"
      "  ((texture) == 0 ? textureLod(diskTable0, uv, 0.0) : textureLod(diskTable1, uv, 0.0))\n";
  std::set<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(tools::shaderLibrary() / "rigel")) {
    files.insert(entry.path().filename().string());
  }
  for (const std::string& file : files) text += "#include \"rigel/" + file + "\"\n";
  return text;
}

struct Function {
  std::string result, name;
  std::vector<std::string> parameters;
};

/// At the commas that are not inside brackets.
std::vector<std::string> splitParameters(const std::string& text) {
  std::vector<std::string> parts(1);
  int depth = 0;
  for (const char c : text) {
    depth += c == '(' || c == '[' ? 1 : c == ')' || c == ']' ? -1 : 0;
    if (c == ',' && depth == 0)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  if (parts.size() == 1 && parts[0].find_first_not_of(" \n") == std::string::npos) parts.clear();
  return parts;
}

/// The functions that a shader's text defines, macros resolved.
std::vector<Function> functionsOf(const std::string& shader) {
  const TemporaryFolder folder;
  writeFile(folder / "all.frag", shader);
  const Outcome resolved = runCommand("glslangValidator -E '-I" + tools::shaderLibrary().string() + "' '" +
                                      (folder / "all.frag").string() + "'");
  EXPECT_EQ(resolved.exitCode, 0) << resolved.out << resolved.err;
  const std::regex form(R"((\w+)\s+(rigel_\w+)\s*\(((?:[^(){};]|\([^(){};]*\))*)\)\s*\{)");
  std::vector<Function> functions;
  for (std::sregex_iterator i(resolved.out.begin(), resolved.out.end(), form), end; i != end; ++i) {
    functions.push_back({(*i)[1], (*i)[2], splitParameters((*i)[3])});
  }
  return functions;
}

/// Text that calls functions with arguments of their types.
class Caller {
 public:
  void call(const Function& function) {
    std::string declarations, arguments;
    for (std::size_t i = 0; i < function.parameters.size(); ++i) {
      const std::string name = "a" + std::to_string(i);
      arguments += (i > 0 ? ", " : "") + argument(function.parameters[i], name, declarations);
    }
    const std::string expression = function.name + "(" + arguments + ")";
    const std::string used = use(function.result, expression);
    body_ += "  {\n" + declarations + "    " + (used.empty() ? "" : "sum += ") + (used.empty() ? expression : used) +
             ";\n  }\n";
  }

  std::string text() const {
    std::string text =
        "layout(location = 0) in vec4 seed;\nlayout(location = 0) out vec4 colour;\n"
        "layout(binding = 1) uniform samplerBuffer texelSource;\n"
        "layout(binding = 2) uniform sampler3D textureSource;\n";
    if (!structs_.empty()) text += "layout(std140, binding = 3) uniform Structs {\n";
    for (const std::string& type : structs_) text += "  " + type + " one" + type + ";\n";
    if (!structs_.empty()) text += "} structs;\n";
    return text + "void main() {\n  float sum = 0.0;\n" + body_ + "  colour = vec4(sum);\n}\n";
  }

 private:
  /// The argument for a parameter; what must be declared first is added to `declarations`.
  std::string argument(const std::string& parameter, const std::string& name, std::string& declarations) {
    static const std::regex kForm(R"(\s*(?:const\s+)?(in\s+|out\s+|inout\s+)?(\w+)\s+\w+\s*(\[.*\])?\s*)");
    std::smatch match;
    EXPECT_TRUE(std::regex_match(parameter, match, kForm)) << parameter;
    const std::string type = match[2];
    if (type == "samplerBuffer") return "texelSource";
    if (type == "sampler3D") return "textureSource";
    const bool isOut = match[1].str().starts_with("out");
    declarations += "    " + type + " " + name + match[3].str();
    if (!match[3].matched) {
      declarations += isOut ? ";\n" : " = " + value(type) + ";\n";
    } else {
      declarations += ";\n";
      if (!isOut) {
        declarations += "    for (int i = 0; i < " + name + ".length(); ++i) " + name + "[i] = " + value(type) + ";\n";
      }
    }
    return name;
  }

  std::string value(const std::string& type) {
    if (type == "bool") return "seed.x > 0.0";
    if (type.starts_with("Gpu") || type.starts_with("Rigel")) {
      structs_.insert(type);
      return "structs.one" + type;
    }
    return type + "(seed.x)";
  }

  /// A float out of a result; "": none to be had, the call alone must do.
  static std::string use(const std::string& type, const std::string& expression) {
    if (type == "float" || type == "int" || type == "uint" || type == "bool") return "float(" + expression + ")";
    if (type.find("vec") != std::string::npos) return "float(" + expression + ".x)";
    return "";
  }

  std::set<std::string> structs_;
  std::string body_;
};

class EveryFunction : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Translation, EveryFunction, ::testing::Range(2, 6));

void translateAll(Coefficients from, int bands, const std::vector<std::string>& languages) {
  const std::vector<Function> functions = functionsOf(head(from, bands) + "void main() {}\n");
  ASSERT_GE(functions.size(), 20u);
  Caller caller;
  for (const Function& function : functions) caller.call(function);
  const TemporaryFolder folder;
  writeFile(folder / "all.frag", head(from, bands) + caller.text());
  for (const std::string& language : languages) {
    const Outcome outcome = translate(language + " '" + (folder / "all.frag").string() + "'");
    ASSERT_EQ(outcome.exitCode, 0) << language << "\n" << outcome.err << contentOf(folder / "all.frag");
    for (const Function& function : functions) {
      EXPECT_THAT(outcome.out, HasSubstr(function.name + "(")) << language;
    }
  }
}

TEST_P(EveryFunction, WithCoefficientsInAUniformBlock) {
  translateAll(Coefficients::block, GetParam(), {"glsl330", "essl300", "hlsl50", "msl21"});
}

TEST(Translation, WithCoefficientsInATexelBuffer) {
  const std::vector<int> some{3}, all{2, 3, 4, 5};
  for (const int bands : fullRun() ? all : some)
    translateAll(Coefficients::texels, bands, {"glsl330", "hlsl50", "msl21"});
}

TEST(Translation, OfTheEntryShaders) {
  int shaders = 0;
  for (const auto& entry : std::filesystem::directory_iterator(RIGEL_ENTRY_SHADERS)) {
    const std::string stage = entry.path().extension();
    if (stage != ".vert" && stage != ".frag" && stage != ".comp") continue;
    ++shaders;
    for (const std::string language : {"glsl330", "hlsl50", "msl21"}) {
      if (language == "glsl330" && stage == ".comp") continue;
      const Outcome outcome = translate(language + " '" + entry.path().string() + "' -DRIGEL_BANDS=3");
      EXPECT_EQ(outcome.exitCode, 0) << language << "\n" << outcome.err;
    }
  }
  EXPECT_GE(shaders, 5);
}

TEST(TranslateScript, SaysWhatIsWrong) {
  const TemporaryFolder folder;
  const std::string file = (folder / "wrong.frag").string();
  writeFile(file, "#version 450\nvoid main() {\n  wrong;\n}\n");
  const Outcome wrong = translate("glsl330 '" + file + "'");
  EXPECT_EQ(wrong.exitCode, 1);
  EXPECT_THAT(wrong.err, HasSubstr("wrong.frag:3: 'wrong' : undeclared identifier"));
  EXPECT_EQ(wrong.out, "");
  EXPECT_EQ(translate("glsl330 '" + (folder / "nowhere.frag").string() + "'").exitCode, 1);
  EXPECT_EQ(translate("").exitCode, 2);
  EXPECT_EQ(translate("glsl330").exitCode, 2);
  EXPECT_EQ(translate("cobol '" + file + "'").exitCode, 2);
  EXPECT_EQ(translate("glsl330 x.comp").exitCode, 2);
  EXPECT_EQ(translate("glsl330 x.txt").exitCode, 2);
  EXPECT_EQ(translate("--help").exitCode, 0);
}

TEST(TranslateScript, TakesDefinesAndFoldersAndWritesAFile) {
  const TemporaryFolder folder;
  writeFile(folder / "own.glsl", "float own() { return VALUE; }\n");
  writeFile(folder / "fine.frag",
            "#version 450\n#extension GL_GOOGLE_include_directive : require\n#include \"own.glsl\"\n"
            "#include \"rigel/sh.glsl\"\nlayout(location = 0) out vec4 c;\n"
            "void main() { c = vec4(own()); }\n");
  const std::string path = folder.path().string();
  const Outcome outcome =
      translate("-DVALUE=0.75 '-I" + path + "' essl300 '" + path + "/fine.frag' -o '" + path + "/translated.frag'");
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(contentOf(folder / "translated.frag"), HasSubstr("0.75"));
}

}  // namespace
}  // namespace rigel::test
