// one_frame PROJECT N IMAGE: composes frame N of a project and writes it as an image file.
#include <cstdio>
#include <cstdlib>

#include "base/image_codecs.h"
#include "frame/compose_frame.h"
#include "project/json.h"
#include "scene/opened_project.h"
#include "scene/scene_files.h"
#include "video/frame_source.h"

// The value, or the end of the program with the text of the error.
template <class Value>
Value value_of(sigs::Result<Value> result) {
  if (result) return std::move(*result);
  std::fprintf(stderr, "error: %s\n", result.error().text().c_str());
  std::exit(1);
}

int main(int argc, char** argv) {
  if (argc != 4) return 64;
  const int number = std::atoi(argv[2]);
  const sigs::Project project = value_of(sigs::read_project(argv[1])).project;
  sigs::FrameSource footage =
      value_of(sigs::FrameSource::open(resolved(project, project.footage.video), nullptr, quantisers_for(project)));
  if (number < 0 || number >= footage.info().frame_count()) return 64;
  const sigs::Scene scene = value_of(sigs::open_scene(project, shape_of(footage.info())));
  sigs::ComposeContext context;  // the renderer; kept from frame to frame
  const auto composed = value_of(compose_frame(scene, number, value_of(footage.read(number)), context));
  return sigs::image_codecs::imwrite(argv[3], bgr_of(composed.image)) ? 0 : 1;
}
