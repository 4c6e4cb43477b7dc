# Small footage of any length, and projects on it. Sourced in the root of the tree, $here; $lot is a scratch folder.
#   small_clip                        makes $lot/small.mp4 (320x240, the sample scaled down) and $lot/lens.xml
#   looped FRAMES                     makes $lot/FRAMES.mp4, the small clip again and again
#   looped_project NAME FRAMES COUNT  makes $lot/NAME.json: so many intruders over FRAMES.mp4
source bench/scaled_sample.sh

small_clip() {
  ffmpeg -v error -i "$here/assets/footage/sample.mp4" -an -vf scale=320:240 -c:v libx264 -crf 20 -pix_fmt yuv420p "$lot/small.mp4"
  scaled_lens 320 240 >"$lot/lens.xml"
}

looped() { # FRAMES
  [ -e "$lot/$1.mp4" ] || ffmpeg -v error -stream_loop -1 -i "$lot/small.mp4" -c copy -frames:v "$1" "$lot/$1.mp4"
}

# Intruders side by side with the camera's velocity, so each keeps its size.
looped_project() { # NAME FRAMES INTRUDERS
  local last=$(($2 - 1)) i list=
  for i in $(seq "$3"); do
    list+="${list:+,}$(awk -v i="$i" -v last="$last" -v model="$here/assets/models/light-aircraft/light-aircraft.obj" 'BEGIN {
      y = 25 * (i % 2 ? 1 : -1) * int(i / 2 + 0.5); z = -165 - 8 * (i % 3)
      printf "{\"name\": \"number-%d\", \"model\": {\"file\": \"%s\", \"forward\": \"+x\", \"up\": \"+z\"}, ", i, model
      printf "\"trajectory\": {\"waypoints\": [{\"frame\": 0, \"position_m\": [80, %d, %d]}, ", y, z
      printf "{\"frame\": %d, \"position_m\": [%.4f, %d, %d]}]}}", last, 80 + 22 * last / 25, y, z }')"
  done
  cat >"$lot/$1.json" <<JSON
{"sigs": 1, "name": "$1", "footage": {"video": "$lot/$2.mp4", "calibration": "$lot/lens.xml"},
 "camera": {"position_m": [0, 0, -150], "speed_mps": 22.0}, "intruders": [$list]}
JSON
}
