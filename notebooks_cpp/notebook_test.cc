// SPDX-License-Identifier: Apache-2.0
// A notebook becomes an .ipynb that shows its own cells with what they printed and drew; a notebook
// that fails, or is not written as it should be, is one line that names the cell, and leaves
// nothing.
#include "notebooks_cpp/notebook.h"

#include <gmock/gmock.h>

#include <fstream>
#include <iostream>

#include "model/base/temporary_directory.h"

namespace skyfit::notebook {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StrEq;
using ::testing::ThrowsMessage;

// The tests below run `page.cell()` as if it stood at a line of this text.
constexpr char kSource[] =
    "// SPDX\n"
    "// %% [markdown]\n"
    "// # Title\n"
    "//\n"
    "// Text.\n"
    "// %%\n"
    "#include <iostream>\n"
    "// %% [hidden]\n"
    "void run_notebook(Page& page) {\n"
    "  // %%\n"
    "  page.cell();\n"
    "  if (true)\n"
    "    std::cout << 1;\n"
    "\n"
    "  // %%\n"
    "  page.cell();\n"
    "  page.figure(\"x.png\");\n"
    "  // %% [hidden]\n"
    "}\n";

// A place at a line of kSource: what the default argument of page.cell() is in a notebook.
struct Line11 {
#line 11 "toy.cpp"
  static std::source_location here() { return std::source_location::current(); }
};
struct Line16 {
#line 16 "toy.cpp"
  static std::source_location here() { return std::source_location::current(); }
};
struct Line9 {
#line 9 "toy.cpp"
  static std::source_location here() { return std::source_location::current(); }
};
#line 58 "notebook_test.cc"

class Folder : public ::testing::Test {
 protected:
  // Exit status and what was said on stderr.
  std::pair<int, std::string> run(void (*notebook)(Page&), const char* source = kSource) {
    std::string program = "toy", folder = folder_.string();
    char* arguments[] = {program.data(), folder.data(), nullptr};
    ::testing::internal::CaptureStderr();
    const int status = execute(2, arguments, source, "toy.cpp", notebook);
    return {status, ::testing::internal::GetCapturedStderr()};
  }

  const TemporaryDirectory temporary_;
  const std::filesystem::path folder_ = temporary_.path();
};

void good_notebook(Page& page) {
  page.cell(Line11::here());
  std::cout << "one\ntwo";
  page.cell(Line16::here());
  std::ofstream(page.scratch("x.png"), std::ios::binary) << "\x89PNG";
  page.figure(page.scratch("x.png"));
  std::cout << "after";
}

TEST_F(Folder, CellsAndOutputsBecomeNbformat45) {
  const auto [status, said] = run(good_notebook);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(said, "");
  const json notebook = json::parse(std::ifstream(folder_ / "toy.ipynb"));
  EXPECT_EQ(notebook["nbformat"], 4);
  EXPECT_EQ(notebook["nbformat_minor"], 5);
  const json& cells = notebook["cells"];
  ASSERT_EQ(cells.size(), 4u);
  EXPECT_EQ(cells[0]["cell_type"], "markdown");
  EXPECT_EQ(cells[0]["source"], json({"# Title\n", "\n", "Text."}));
  EXPECT_EQ(cells[1]["execution_count"], nullptr);
  EXPECT_EQ(cells[2]["source"], json({"if (true)\n", "  std::cout << 1;"}));
  EXPECT_EQ(cells[2]["execution_count"], 1);
  EXPECT_EQ(cells[2]["outputs"][0]["text"], json({"one\n", "two"}));
  EXPECT_EQ(cells[3]["outputs"][0]["data"]["image/png"], "iVBORw==");
  EXPECT_EQ(cells[3]["outputs"][1]["text"], json({"after"}));
}

TEST_F(Folder, AFailingCellIsNamedAndLeavesNothing) {
  const auto [status, said] = run([](Page& page) {
    page.cell(Line11::here());
    throw std::runtime_error("no such sky");
  });
  EXPECT_EQ(status, 1);
  EXPECT_EQ(said, "toy.cpp:10: cell failed: no such sky\n");
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(Folder, ACellThatDidNotRunIsNamed) {
  const auto [status, said] = run([](Page& page) { page.cell(Line11::here()); });
  EXPECT_EQ(status, 1);
  EXPECT_EQ(said, "toy.cpp:15: the cell did not run: expected page.cell() in it\n");
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(Folder, ACallOutsideOfCellsOrTwiceIsNamed) {
  EXPECT_EQ(run([](Page& page) { page.cell(Line9::here()); }).second,
            "toy.cpp:9: page.cell() stands in no code cell\n");
  EXPECT_EQ(run([](Page& page) {
              page.cell(Line11::here());
              page.cell(Line11::here());
            }).second,
            "toy.cpp:11: the cell ran twice\n");
}

TEST_F(Folder, MarkdownWithoutCodeIsRefused) {
  EXPECT_EQ(run([](Page&) {}, "// %% [markdown]\n// text\n").second, "toy.cpp:1: no code cell\n");
}

TEST_F(Folder, AnUnwritableTargetIsNamed) {
  std::filesystem::create_directory(folder_ / "toy.ipynb");
  const auto [status, said] = run(good_notebook);
  EXPECT_EQ(status, 1);
  EXPECT_EQ(said, (folder_ / "toy.ipynb").string() +
                      ": expected the name of a file, this is a directory\n");
}

TEST(Percent, BadCellsAreRefusedWithTheirLine) {
  const auto parse = [](const char* text) { return [text] { parse_percent(text, "n.cpp"); }; };
  EXPECT_THAT(parse("// %% [python]\nx\n"),
              ThrowsMessage<std::invalid_argument>(HasSubstr("n.cpp:1: cell \"[python]\"")));
  EXPECT_THAT(parse("// %% [markdown]\nint x;\n"),
              ThrowsMessage<std::invalid_argument>(HasSubstr("n.cpp:2: code in a markdown cell")));
  EXPECT_THAT(parse("// %%\nint x;\n// %%\n\n"),
              ThrowsMessage<std::invalid_argument>(StrEq("n.cpp:3: empty cell")));
}

TEST(Percent, LinesAreThoseOfTheFile) {
  const auto cells = parse_percent("a\n// %%\nb\n\n  // %%\n  c\n    d\n", "n.cpp");
  ASSERT_EQ(cells.size(), 2u);
  EXPECT_EQ(cells[0].source, "b");
  EXPECT_EQ(cells[1].source, "c\n  d");
  EXPECT_THAT((std::vector{cells[0].first_line, cells[0].last_line, cells[1].first_line,
                           cells[1].last_line}),
              ElementsAre(2, 4, 5, 7));
}

}  // namespace
}  // namespace skyfit::notebook
