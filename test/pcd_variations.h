// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// What programs do to one part of a PCD file or another.

#include "pcd_forms.h"

#include <pcl/pcl_config.h>

#include <algorithm>
#include <cctype>

namespace pcl_flashreg::io::forms {

/** \brief Whether every version of PCL reads a file with the points that it has; the
 * others are not asked, since they crash on some. */
enum class Pcl { Reads, NotCompressed, NotAsked };

/** \brief One way to write one part of a file. */
struct Variation {
  const char* label;
  Pcl pcl;
  void (*change)(Form&);

  bool
  pclReads(Encoding encoding) const
  {
    return pcl == Pcl::Reads ||
           (pcl == Pcl::NotCompressed && encoding != Encoding::Compressed);
  }
};

constexpr std::array<double, 7> NO_VIEWPOINT = {0, 0, 0, 1, 0, 0, 0};

/** \brief What the fields are; in front, since they make the lines anew. */
inline std::vector<Variation>
columnVariations()
{
  return {
      {"a byte", Pcl::Reads, [](Form&) {}},
      {"coordinates alone",
       Pcl::Reads,
       [](Form& f) {
         f.setColumns({{"x"}, {"y"}, {"z"}});
       }},
      {"all integers",
       Pcl::Reads,
       [](Form& f) {
         f.setColumns({{"x"},
                       {"y"},
                       {"z"},
                       {"a", 'I', 1},
                       {"b", 'U', 1},
                       {"c", 'I', 2},
                       {"d", 'U', 2},
                       {"e", 'I', 4},
                       {"f", 'U', 4},
                       {"g", 'I', 8},
                       {"h", 'U', 8}});
       }},
      {"floats, doubles, a histogram",
       Pcl::Reads,
       [](Form& f) {
         f.setColumns({{"normal_x"},
                       {"x"},
                       {"stamp", 'F', 8},
                       {"y"},
                       {"h", 'F', 4, 5},
                       {"z"},
                       {"rgb"}});
       }},
      {"a byte in front",
       Pcl::Reads,
       [](Form& f) {
         f.setColumns({{"tag", 'U', 1}, {"x"}, {"y"}, {"z"}});
       }},
      {"truth values",
       Pcl::Reads,
       [](Form& f) {
         f.setColumns({{"valid", 'B', 1}, {"x"}, {"y"}, {"z"}, {"edge", 'B', 1, 2}});
       }},
      {"one name twice",
       Pcl::Reads,
       [](Form& f) {
         f.setColumns({{"i", 'U', 1},
                       {"x"},
                       {"y"},
                       {"z"},
                       {"i", 'U', 2, 1, "i_3"},
                       {"i_2", 'U', 1},
                       {"i", 'F', 4, 1, "i_4"}});
       }},
      {"coordinates twice",
       Pcl::Reads,
       [](Form& f) {
         f.setColumns({{"x"},
                       {"y"},
                       {"z"},
                       {"x", 'F', 4, 1, "x_2"},
                       {"y", 'F', 4, 1, "y_2"},
                       {"z", 'F', 4, 1, "z_2"}});
       }},
      {"coordinates twice, the first as doubles",
       Pcl::Reads,
       [](Form& f) {
         f.setColumns({{"x", 'F', 8, 1, "x_2"},
                       {"y", 'F', 8, 1, "y_2"},
                       {"x"},
                       {"y"},
                       {"z"},
                       {"z", 'F', 8, 1, "z_2"}});
       }},
      // PCL takes padding out of the compressed body, not out of the point.
      {"padding",
       Pcl::NotCompressed,
       [](Form& f) {
         f.setColumns({{"x"},
                       {"_", 'U', 1, 3, ""},
                       {"y"},
                       {"z"},
                       {"_", 'U', 1, 4, ""},
                       {"i", 'U', 2}});
       }},
      // PCL's older versions refuse a COUNT of 0.
      {"COUNT 0",
       PCL_VERSION_COMPARE(>=, 1, 13, 0) ? Pcl::Reads : Pcl::NotAsked,
       [](Form& f) {
         f.setColumns({{"gone", 'F', 8, 0, ""},
                       {"x"},
                       {"y"},
                       {"z"},
                       {"ring", 'U', 2},
                       {"_", 'U', 1, 0, ""}});
       }},
      // PCL takes these for empty in the compressed body, but not in the point.
      {"half floats behind",
       Pcl::NotCompressed,
       [](Form& f) {
         f.setColumns({{"x"}, {"y"}, {"z"}, {"h", 'F', 2, 2}});
       }},
      {"an unknown letter behind",
       Pcl::NotCompressed,
       [](Form& f) {
         f.setColumns({{"x"}, {"y"}, {"z"}, {"a"}, {"q", 'Q', 4, 2, ""}});
       }},
      {"unknown sizes behind",
       Pcl::NotCompressed,
       [](Form& f) {
         f.setColumns({{"x"},
                       {"y"},
                       {"z"},
                       {"long_double", 'F', 16, 1, ""},
                       {"tiny", 'F', 1, 1, ""},
                       {"odd", 'I', 3, 1, ""},
                       {"truth", 'B', 4, 1, ""}});
       }},
      {"half floats and the unknown in front",
       Pcl::NotCompressed,
       [](Form& f) {
         f.setColumns({{"h", 'F', 2, 2}, {"q", 'Q', 4, 2, ""}, {"x"}, {"y"}, {"z"}});
       }},
      // PCL takes float32 for coordinates, and nothing else.
      {"coordinates as doubles",
       Pcl::NotAsked,
       [](Form& f) {
         f.setColumns({{"x", 'F', 8}, {"y", 'F', 8}, {"z", 'F', 8}});
       }},
      {"coordinates as half floats",
       Pcl::NotAsked,
       [](Form& f) {
         f.setColumns({{"x", 'F', 2}, {"y", 'F', 2}, {"z", 'F', 2}});
       }},
      {"coordinates as integers",
       Pcl::NotAsked,
       [](Form& f) {
         f.setColumns({{"x", 'I', 4}, {"y", 'I', 2}, {"z", 'U', 1}});
       }},
      {"coordinates in capitals",
       Pcl::NotAsked,
       [](Form& f) {
         f.setColumns(
             {{"X", 'F', 4, 1, "x"}, {"Y", 'F', 4, 1, "y"}, {"Z", 'F', 4, 1, "z"}});
       }},
      {"other fields in capitals",
       Pcl::Reads,
       [](Form& f) {
         f.setColumns({{"X"}, {"Y"}, {"Z"}, {"x"}, {"y"}, {"z"}});
       }},
  };
}

/** \brief How many points there are, and in which order. */
inline std::vector<Variation>
shapeVariations()
{
  return {
      {"in no order", Pcl::Reads, [](Form&) {}},
      {"organized",
       Pcl::Reads,
       [](Form& f) {
         f.width = 2;
         f.height = 3;
         f.set("WIDTH", "2");
         f.set("HEIGHT", "3");
       }},
      {"numbers with a point",
       Pcl::Reads,
       [](Form& f) {
         f.set("WIDTH", "6.0");
         f.set("HEIGHT", "1.");
         f.set("POINTS", "6.000");
       }},
      {"numbers with a plus", Pcl::Reads, [](Form& f) { f.set("WIDTH", "+6"); }},
      {"words after the numbers",
       Pcl::Reads,
       [](Form& f) {
         f.set("WIDTH", "6 # points");
         f.set("HEIGHT", "1 2");
         f.set("POINTS", "6, all of them");
       }},
      {"neither WIDTH nor HEIGHT",
       Pcl::Reads,
       [](Form& f) {
         f.remove("WIDTH");
         f.remove("HEIGHT");
       }},
      {"no HEIGHT", Pcl::Reads, [](Form& f) { f.remove("HEIGHT"); }},
      {"no HEIGHT, and WIDTH 0",
       Pcl::Reads,
       [](Form& f) {
         f.remove("HEIGHT");
         f.set("WIDTH", "0");
       }},
      // The others PCL refuses, or did in one version or another.
      {"no WIDTH",
       Pcl::NotAsked,
       [](Form& f) {
         f.remove("WIDTH");
         f.set("HEIGHT", "3");
         f.width = 2;
         f.height = 3;
       }},
      {"no POINTS", Pcl::NotAsked, [](Form& f) { f.remove("POINTS"); }},
      {"WIDTH 0 and HEIGHT 0",
       Pcl::NotAsked,
       [](Form& f) {
         f.set("WIDTH", "0");
         f.set("HEIGHT", "0");
       }},
      {"WIDTH 0", Pcl::NotAsked, [](Form& f) { f.set("WIDTH", "0"); }},
      {"HEIGHT 0", Pcl::NotAsked, [](Form& f) { f.set("HEIGHT", "0"); }},
      {"HEIGHT that does not divide POINTS",
       Pcl::NotAsked,
       [](Form& f) {
         f.remove("WIDTH");
         f.set("HEIGHT", "4");
       }},
      {"an exponent",
       Pcl::NotAsked,
       [](Form& f) {
         f.set("WIDTH", "0.6e1");
         f.set("POINTS", "6e0");
       }},
  };
}

inline std::vector<Variation>
viewpointVariations()
{
  return {
      {"seven numbers", Pcl::Reads, [](Form&) {}},
      {"eight numbers",
       Pcl::Reads,
       [](Form& f) { f.set("VIEWPOINT", "1 2 3 0.5 -0.5 0.5 -0.5 0"); }},
      {"no VIEWPOINT",
       Pcl::Reads,
       [](Form& f) {
         f.remove("VIEWPOINT");
         f.viewpoint = NO_VIEWPOINT;
       }},
      // PCL reads the points of these, and a viewpoint that is none.
      {"commas",
       Pcl::Reads,
       [](Form& f) {
         f.set("VIEWPOINT", "1, 2, 3, 0.5, -0.5, 0.5, -0.5");
         f.pcl_keeps_viewpoint = false;
       }},
      {"words",
       Pcl::Reads,
       [](Form& f) {
         f.set("VIEWPOINT", "a b c d e f g");
         f.pcl_keeps_viewpoint = false;
         f.viewpoint = NO_VIEWPOINT;
       }},
      {"not finite",
       Pcl::Reads,
       [](Form& f) {
         f.set("VIEWPOINT", "nan nan nan 1 0 0 0");
         f.pcl_keeps_viewpoint = false;
         f.viewpoint = NO_VIEWPOINT;
       }},
      {"three numbers",
       Pcl::NotAsked,
       [](Form& f) {
         f.set("VIEWPOINT", "1 2 3");
         f.viewpoint = {1, 2, 3, 1, 0, 0, 0};
       }},
      {"commas alone",
       Pcl::NotAsked,
       [](Form& f) { f.set("VIEWPOINT", "1,2,3,0.5,-0.5,0.5,-0.5"); }},
      {"nothing",
       Pcl::NotAsked,
       [](Form& f) {
         f.set("VIEWPOINT", "");
         f.viewpoint = NO_VIEWPOINT;
       }},
  };
}

/** \brief Turns every word of the TYPE line into another one. */
template <typename Turn>
void
turnTypes(Form& f, Turn turn)
{
  std::string types;
  for (const Column& column : f.columns)
    types += " " + turn(column.type);
  f.set("TYPE", types.substr(1));
}

inline std::vector<Variation>
fieldLineVariations()
{
  return {
      {"FIELDS", Pcl::Reads, [](Form&) {}},
      {"COLUMNS",
       Pcl::Reads,
       [](Form& f) { f.lines[f.indexOf("FIELDS")].key = "COLUMNS"; }},
      {"small letters",
       Pcl::Reads,
       [](Form& f) {
         turnTypes(f, [](char type) {
           return std::string(1, static_cast<char>(type - 'A' + 'a'));
         });
       }},
      {"long types",
       Pcl::Reads,
       [](Form& f) {
         turnTypes(f, [](char type) { return std::string(1, type) + "xyz"; });
       }},
      {"no COUNT where all are 1",
       Pcl::Reads,
       [](Form& f) {
         if (std::all_of(f.columns.begin(), f.columns.end(), [](const Column& column) {
               return column.count == 1;
             }))
           f.remove("COUNT");
       }},
      {"coordinates alone, by their names",
       Pcl::Reads,
       [](Form& f) {
         f.setColumns({{"x"}, {"y"}, {"z"}});
         for (const char* key : {"SIZE", "TYPE", "COUNT"})
           f.remove(key);
       }},
  };
}

inline std::vector<Variation>
versionVariations()
{
  return {
      {".7", Pcl::Reads, [](Form&) {}},
      {"0.7", Pcl::Reads, [](Form& f) { f.set("VERSION", "0.7"); }},
      {"words", Pcl::Reads, [](Form& f) { f.set("VERSION", "0.7 # of PCD"); }},
      {"no word", Pcl::Reads, [](Form& f) { f.set("VERSION", ""); }},
      {"no VERSION", Pcl::Reads, [](Form& f) { f.remove("VERSION"); }},
      {"no comment in front", Pcl::Reads, [](Form& f) { f.top = ""; }},
      {"comments and blank lines in front",
       Pcl::Reads,
       [](Form& f) { f.top = "\n#\n## .PCD\n\n   # SIZE 1 2 3\n"; }},
      {"comments and blank lines between",
       Pcl::Reads,
       [](Form& f) { f.between_header_lines = "\n# DATA binary\n"; }},
      {"lines of blanks between",
       Pcl::NotAsked,
       [](Form& f) { f.between_header_lines = " \t\n"; }},
      {"a byte order mark",
       Pcl::NotAsked,
       [](Form& f) { f.top = "\xef\xbb\xbf" + f.top; }},
  };
}

inline std::vector<Variation>
blankVariations()
{
  return {
      {"blanks", Pcl::Reads, [](Form&) {}},
      {"tabs", Pcl::Reads, [](Form& f) { f.separator = f.value_separator = "\t"; }},
      {"many blanks",
       Pcl::Reads,
       [](Form& f) { f.separator = f.value_separator = " \t "; }},
      {"blanks behind", Pcl::Reads, [](Form& f) { f.after_line = " \t"; }},
      {"blanks in front", Pcl::Reads, [](Form& f) { f.before_line = "  "; }},
      {"commas behind the values",
       Pcl::Reads,
       [](Form& f) { f.value_separator = ", "; }},
      {"commas alone", Pcl::NotAsked, [](Form& f) { f.value_separator = ","; }},
      {"empty lines between the points",
       Pcl::Reads,
       [](Form& f) { f.between_points = "\n\n"; }},
      {"lines of blanks, and comments, between the points",
       Pcl::NotAsked,
       [](Form& f) { f.between_points = "  \n# and\n"; }},
  };
}

inline std::vector<Variation>
lineEndVariations()
{
  return {{"LF", Pcl::Reads, [](Form&) {}},
          {"CR LF", Pcl::Reads, [](Form& f) { f.line_end = "\r\n"; }}};
}

inline std::vector<Variation>
dataVariations()
{
  return {
      {"DATA", Pcl::Reads, [](Form&) {}},
      {"a word behind DATA", Pcl::Reads, [](Form& f) { f.data = "* # body"; }},
      {"more of a word", Pcl::Reads, [](Form& f) { f.data = "*#body"; }},
      // Ascii is read by some versions, Binary by none.
      {"a capital", Pcl::NotAsked, [](Form& f) { f.capital_encoding = true; }},
  };
}

inline std::vector<Variation>
orderVariations()
{
  return {
      {"PCL's order", Pcl::Reads, [](Form&) {}},
      {"VIEWPOINT first", Pcl::Reads, [](Form& f) { f.move("VIEWPOINT", "FIELDS"); }},
      {"the shape first",
       Pcl::Reads,
       [](Form& f) {
         f.move("WIDTH", "FIELDS");
         f.move("HEIGHT", "FIELDS");
       }},
      {"POINTS before WIDTH", Pcl::Reads, [](Form& f) { f.move("POINTS", "WIDTH"); }},
      {"the version last", Pcl::Reads, [](Form& f) { f.move("VERSION", "POINTS"); }},
      // PCL asks for FIELDS, SIZE, TYPE, COUNT and POINTS in this order.
      {"TYPE before SIZE", Pcl::NotAsked, [](Form& f) { f.move("TYPE", "SIZE"); }},
      {"COUNT before FIELDS",
       Pcl::NotAsked,
       [](Form& f) { f.move("COUNT", "FIELDS"); }},
      {"POINTS first", Pcl::NotAsked, [](Form& f) { f.move("POINTS", "VERSION"); }},
      {"POINTS before SIZE", Pcl::NotAsked, [](Form& f) { f.move("POINTS", "SIZE"); }},
      {"backwards",
       Pcl::NotAsked,
       [](Form& f) { std::reverse(f.lines.begin(), f.lines.end()); }},
  };
}

inline std::vector<Variation>
keywordVariations()
{
  return {
      {"keywords in capitals", Pcl::Reads, [](Form&) {}},
      {"longer keywords",
       Pcl::Reads,
       [](Form& f) {
         for (const char* key : {"SIZE", "TYPE", "VIEWPOINT"})
           if (f.indexOf(key) < f.lines.size())
             f.lines[f.indexOf(key)].key += "S";
       }},
      {"keywords in small letters",
       Pcl::NotAsked,
       [](Form& f) {
         for (Form::Line& line : f.lines)
           for (char& c : line.key)
             c = static_cast<char>(std::tolower(c));
       }},
  };
}

/** \brief One of each group together make a file; to be applied in this order. */
inline std::vector<std::vector<Variation>>
variations()
{
  return {columnVariations(),
          shapeVariations(),
          viewpointVariations(),
          fieldLineVariations(),
          versionVariations(),
          blankVariations(),
          lineEndVariations(),
          dataVariations(),
          orderVariations(),
          keywordVariations()};
}

} // namespace pcl_flashreg::io::forms
