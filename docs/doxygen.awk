# SPDX-License-Identifier: Apache-2.0
# Shows the comments of a header to Doxygen: the one at its head as that of the file, those before and behind a
# declaration as its own. What Doxygen would take for a command or a tag is escaped. Line numbers stay.
function shown(text, marker) {
  at = index(text, "//")
  comment = substr(text, at + 2)
  gsub(/[<#@\\]/, "\\\\&", comment)
  return substr(text, 1, at - 1) marker comment
}
NR == 1 { print "/// \\file"; next }
/^ *\/\/( |$)/ { print shown($0, "///"); next }
/[^:"]\/\/ / && !/^ *#/ { print shown($0, "///<"); next }
{ print }
