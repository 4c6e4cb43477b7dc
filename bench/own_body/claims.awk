# Checks the statements of docs/research/own-body.md against the tables: prints each one that the figures no longer support.
#   awk -F, -f claims.awk flights.csv limits.csv real.csv time.csv early.csv
function claim(holds, text) { if (!holds) { print "no longer so: " text; broken = 1 } }
FNR == 1 { next }
FILENAME ~ /flights\.csv$/ && $(NF - 5) == "stable" {
  if ($(NF - 1) == "no") claim($NF == "cannot tell", $1 ": stable says that nothing can be told")
  else if ($1 == "none") claim($NF == "mask" && $(NF - 2) == 0, "none: stable finds nothing")
  else claim($(NF - 4) >= 0.95, $1 ", " $(NF - 7) " px wide: stable agrees by 0.95 and more")
}
# A flight may have a comma in its name; the fields behind it are counted from the end.
FILENAME ~ /limits\.csv$/ && $(NF - 5) == "stable" && $1 ~ /^(trembles by 1 to 4 px|no sway at all|a tenth of the sway)$/ {
  claim($(NF - 4) >= 0.95, $1 ": stable agrees by 0.95 and more")
}
FILENAME ~ /limits\.csv$/ && $(NF - 5) == "stable" && $1 ~ /^(trembles by 2 to 8 px.*|clouds and nothing else|grain of 8 codes|plain sky first)$/ {
  claim($(NF - 4) < 0.9, $1 ": stable fails")
}
FILENAME ~ /limits\.csv$/ && $(NF - 5) == "stable" && $1 ~ /^clear sky/ { claim($NF == "cannot tell", $1 ": stable says so") }
FILENAME ~ /real\.csv$/ && $2 == "stable" && $5 == "none" { claim($4 == 0, $1 ": stable finds nothing") }
FILENAME ~ /real\.csv$/ && $2 == "stable" && $5 == "still" { claim($6 == "cannot tell", $1 ": stable says that nothing can be told") }
FILENAME ~ /real\.csv$/ && $2 == "stable" && $5 == "known" {
  if ($1 ~ /belly/) claim($3 < 0.9, $1 ": stable fails")
  else claim($3 >= 0.9, $1 ": stable agrees by 0.9 and more")
}
FILENAME ~ /time\.csv$/ && $1 == "stable" && $2 == 1500 && $3 == 1 && $4 == 0 {
  claim($11 <= 1.3, "1500 frames take at most 1.3 times what decoding takes")
  claim($7 >= 0.95, "1500 frames of 1280 x 960: stable agrees by 0.95 and more")
}
FILENAME ~ /reliability\.csv$/ && $2 == 0.9 { claim($4 >= 0.95 * $3, $1 ": of what is 0.9 sure and more, 0.95 are body") }
FILENAME ~ /early\.csv$/ { claim($5 >= $6 - 0.01, $1 ": stopping early costs less than 0.01") }
FILENAME ~ /early\.csv$/ && $1 == "plain sky first" { claim($3 > $4 / 2, $1 ": no stop before the ground is seen") }
END { exit broken }
