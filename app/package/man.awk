# Turns one part of a help text into troff. part: usage; text, which stands above it; entries, the options below it.

function escaped(text) {
  gsub(/\\/, "\\e", text)
  gsub(/-/, "\\-", text)
  sub(/^[.']/, "\\\\\\&&", text)
  return text
}
function name_of(text) {
  gsub(/\{false\}/, "", text)
  if (match(text, /:[A-Z]+ in \[[^]]*\]/)) {
    range = substr(text, RSTART, RLENGTH)
    gsub(/^:[A-Z]+ in \[|\]$/, "", range)
    sub(/ - /, " to ", range)
    text = substr(text, 1, RSTART - 1) " (" range ")" substr(text, RSTART + RLENGTH)
  }
  return text
}

/^Usage: / { seen = 1; if (part == "usage") print ".br\n" escaped(substr($0, 8)); next }
!seen { if (part == "text" && NF) print ".PP\n" escaped(toupper(substr($0, 1, 1)) substr($0, 2) ($0 ~ /\.$/ ? "" : ".")); next }
part != "entries" { next }
/^[A-Z][a-z]+:$/ { skipped = $0 == "Subcommands:"; next }
skipped || !NF { next }
/^  [^ ]/ {
  entry = substr($0, 3)
  meaning = ""
  if (match(entry, /   *[^ ]/)) {
    meaning = substr(entry, RSTART + RLENGTH - 1)
    entry = substr(entry, 1, RSTART - 1)
  }
  print ".TP\n.B " escaped(name_of(entry))
  if (meaning != "") print escaped(meaning)
  next
}
{ sub(/^ +/, ""); print escaped($0) }
