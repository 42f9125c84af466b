#!/bin/sh
# Draws docs/pictures/collapse.svg anew: the collapse of the dry and of the cohesive column, one
# above the other, four moments each. Usage: scripts/pictures.sh [PROGRAM]; needs no other tool.
set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
program=${1:-$root/build/conebench}
out=$root/docs/pictures
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

moments=4
width=800
mkdir -p "$out"
for scene in column-dry column-cohesive; do
  "$program" simulate "$scene" -o "$work/$scene" --frames $moments > "$work/$scene.txt"
  sed "s/^/$scene: /" "$work/$scene.txt" >&2
done

# Height of a picture, from viewBox="0 0 WIDTH HEIGHT".
height_of() { sed -n '1s/.*viewBox="0 0 [0-9]* \([0-9]*\)".*/\1/p' "$1"; }

row=$(height_of "$work/column-dry/frame_000.svg")
other=$(height_of "$work/column-cohesive/frame_000.svg")
[ "$other" -gt "$row" ] && row=$other
{
  printf '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 %d %d">\n' \
    $((moments * width)) $((2 * row))
  line=0
  for scene in column-dry column-cohesive; do
    moment=0
    while [ $moment -lt $moments ]; do
      picture=$work/$scene/frame_00$moment.svg
      # Names of colours are the document's: each picture gets its own.
      sed -e "1s/<svg /<svg x=\"$((moment * width))\" y=\"$((line * row))\" width=\"$width\" height=\"$(height_of "$picture")\" /" \
        -e "s/id=\"/id=\"p$line$moment/g" -e "s/url(#/url(#p$line$moment/g" "$picture"
      moment=$((moment + 1))
    done
    line=$((line + 1))
  done
  printf '</svg>\n'
} > "$work/collapse.svg"
mv "$work/collapse.svg" "$out/collapse.svg"
echo "$out/collapse.svg" >&2
