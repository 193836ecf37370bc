#!/bin/sh
# Writes the man page of the program from what --help says of it and of each command. Usage: man.sh PROGRAM VERSION
set -eu
here=$(dirname "$0")
help() { "$1" ${2:+"$2"} --help; }
commands=$(help "$1" | awk '/^Subcommands:/ {on = 1; next} on && NF {print $1}')

printf '.TH SBCOLLIDE 1 "" "sbcollide %s" "User Commands"\n' "$2"
printf '.SH NAME\nsbcollide \\- collision and self-collision of soft bodies, live\n.SH SYNOPSIS\n'
for command in "" $commands; do help "$1" "$command" | awk -v part=usage -f "$here/man.awk"; done
printf '.SH DESCRIPTION\n'
help "$1" | awk -v part=text -f "$here/man.awk"
printf '.SH OPTIONS\n'
help "$1" | awk -v part=entries -f "$here/man.awk"
printf '.SH COMMANDS\n'
for command in $commands; do
  printf '.SS %s\n' "$command"
  help "$1" "$command" | awk -v part=text -f "$here/man.awk"
  help "$1" "$command" | awk -v part=entries -f "$here/man.awk"
done
printf '.SH EXIT STATUS\n0, or 2 after an error, which one line on standard error explains.\n'
