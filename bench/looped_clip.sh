# Small footage of any length, and projects on it. Sourced; $here is the root of the tree, $lot a scratch folder.
#   small_clip                        makes $lot/small.mp4 (320x240, the sample scaled down) and $lot/lens.xml
#   looped FRAMES                     makes $lot/FRAMES.mp4, the small clip again and again
#   looped_project NAME FRAMES COUNT  makes $lot/NAME.json: so many intruders over FRAMES.mp4
small_clip() {
  ffmpeg -v error -i "$here/assets/footage/sample.mp4" -an -vf scale=320:240 -c:v libx264 -crf 20 -pix_fmt yuv420p "$lot/small.mp4"
  # The sample's lens at a quarter of its size.
  cat >"$lot/lens.xml" <<'XML'
<?xml version="1.0"?>
<opencv_storage>
<image_width>320</image_width>
<image_height>240</image_height>
<fisheye_model>1</fisheye_model>
<camera_matrix type_id="opencv-matrix"><rows>3</rows><cols>3</cols><dt>d</dt>
  <data>140.4575 0. 160.3025 0. 140.3175 118.965 0. 0. 1.</data></camera_matrix>
<distortion_coefficients type_id="opencv-matrix"><rows>4</rows><cols>1</cols><dt>d</dt>
  <data>0.0432 0.0115 -0.0104 0.0021</data></distortion_coefficients>
</opencv_storage>
XML
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
