# SPDX-License-Identifier: MIT
"""Several cameras on one aircraft: each as a project with one, all of them at one time, and their export."""

import json
import pickle
import unittest

import numpy as np
import support

import sigs

MOUNTS = {"front": {}, "left": {"position_m": [0, -0.5, 0], "attitude_deg": {"yaw": -12}}, "late": {}}
OFFSETS_S = {"front": 0, "left": 0.37, "late": 5}  # the footage is at 25 frames/s


def rig_file(folder):
    """The sample with its footage in three cameras, of which the last begins 5 s later."""
    document = json.loads(support.CROSSING.read_text())
    footage = document.pop("footage")
    for key, value in footage.items():
        if isinstance(value, str) and (support.CROSSING.parent / value).is_file():
            footage[key] = str((support.CROSSING.parent / value).resolve())
    for intruder in document["intruders"]:
        intruder["model"]["file"] = str((support.CROSSING.parent / intruder["model"]["file"]).resolve())
    document["cameras"] = [
        {"name": name, "footage": footage, "mount": mount, "clock": {"offset_s": OFFSETS_S[name]}}
        for name, mount in MOUNTS.items()
    ]
    document.setdefault("export", {})["labels"] = ["xml"]
    (folder / "rig.json").write_text(json.dumps(document))
    return folder / "rig.json"


class Cameras(support.InFolder):
    def setUp(self):
        super().setUp()
        self.path = rig_file(self.folder)
        self.rig = sigs.open(self.path)

    def test_cameras_have_names_and_fields(self):
        self.assertEqual([(one.index, one.name) for one in self.rig.cameras], list(enumerate(MOUNTS)))
        self.assertEqual(self.rig.cameras[1]["clock.offset_s"], 0.37)
        self.rig.cameras[1]["clock.offset_s"] = 0.4
        self.assertEqual(self.rig["cameras[1].clock.offset_s"], 0.4)
        self.assertEqual(sigs.open(support.CROSSING).cameras, [])
        self.assertIsNone(self.rig.camera_name)

    def test_what_needs_one_camera_says_which_there_are(self):
        for asked in (self.rig.frames, lambda: self.rig.render(0), lambda: self.rig.footage, lambda: self.rig.frame_range):
            with self.assertRaisesRegex(sigs.UsageError, r"rig\.json: .*front, left, late.*camera\(") as caught:
                asked()
            self.assertNotIn("\n", str(caught.exception))
        for wrong in ("up", 3, -1):
            with self.assertRaises(sigs.UsageError):
                self.rig.camera(wrong)
        with self.assertRaisesRegex(sigs.UsageError, "front, left and late|front, left, late"):
            self.rig.camera("up")
        with self.assertRaisesRegex(sigs.UsageError, "one camera"):
            sigs.open(support.CROSSING).render_all(0)
        with self.assertRaises(sigs.UsageError):
            sigs.open(support.CROSSING).camera("front")

    def test_a_camera_is_a_project_of_its_own_whose_text_is_the_rig(self):
        left = self.rig.camera("left")
        self.assertEqual((left.camera_name, left.cameras), ("left", []))
        self.assertEqual(self.rig.camera(1).camera_name, "left")
        left["camera.speed_mps"] = 31
        self.assertEqual(self.rig["camera.speed_mps"], 22)
        again = sigs.Project.parse(left.text(), self.path)
        self.assertEqual([one.name for one in again.cameras], list(MOUNTS))
        self.assertEqual((again["camera.speed_mps"], again["name"]), (31, self.rig["name"]))
        for copy in (left.copy(), pickle.loads(pickle.dumps(left))):
            self.assertEqual((copy.camera_name, copy["camera.speed_mps"]), ("left", 31))

    def test_a_single_camera_of_the_first_mount_sees_what_the_sample_sees(self):
        front, sample = self.rig.camera("front"), sigs.open(support.CROSSING)
        self.assertEqual(front.frame_range, sample.frame_range)
        self.assertEqual(support.samples(front.render(100)), support.samples(sample.render(100)))

    def test_times_of_a_camera_are_those_of_the_rig(self):
        times_s = self.rig.camera("left").footage.times_s
        np.testing.assert_allclose(times_s, 0.37 + np.arange(len(times_s)) / 25, atol=1e-6)
        self.assertAlmostEqual(self.rig.camera("left").render(10).time_s, 0.77)

    def test_all_cameras_at_a_time_give_the_frames_nearest_to_it(self):
        frames = self.rig.render_all(100)
        self.assertEqual(list(frames), ["front", "left"])  # the late one begins at frame 125 of the first
        self.assertEqual((frames["front"].index, frames["left"].index), (100, 91))  # 4 s - 0.37 s = 90.75 frames
        for name, frame in frames.items():
            alone = self.rig.camera(name).render(frame.index)
            self.assertEqual(support.samples(frame), support.samples(alone), name)
            self.assertEqual(frame.truth.intruders[0].distance_m, alone.truth.intruders[0].distance_m)
        self.assertEqual(list(self.rig.render_all(125)), ["front", "left", "late"])
        self.assertEqual(self.rig.render_all(125)["late"].index, 0)
        self.assertNotIn("late", self.rig.render_all(124))  # it is a whole interval off

    def test_changes_and_poses_count_in_all_cameras(self):
        before = self.rig.render_all(100)
        moved = self.rig.render_all(100, poses={0: ([600, 30, -170], (0, 0, 90))})
        for name, frame in before.items():
            self.assertNotEqual(frame.truth.intruders[0].distance_m, moved[name].truth.intruders[0].distance_m)
        self.rig["cameras[1].mount.attitude_deg.yaw"] = -11
        turned = self.rig.render_all(100)
        self.assertEqual(support.samples(turned["front"]), support.samples(before["front"]))
        y_before_m, y_turned_m = (f["left"].truth.intruders[0].position_m[1] for f in (before, turned))
        self.assertLess(y_turned_m, y_before_m)  # turned to the right, so it is farther to the left
        self.rig.close()
        self.assertEqual(support.samples(self.rig.render_all(100)["left"]), support.samples(turned["left"]))

    def test_an_export_writes_what_the_program_writes_and_is_read_again(self):
        done = []
        report = sigs.export(self.rig, self.folder / "mine", frames=range(120, 130), progress=lambda *d: done.append(d))
        support.exported(self.path, self.folder / "program", "--frames", "120-129")
        files = sorted(path.name for path in (self.folder / "program").iterdir())
        self.assertEqual(sorted(path.name for path in report.written), files)
        for name in files:
            self.assertEqual((self.folder / "mine" / name).read_bytes(), (self.folder / "program" / name).read_bytes(), name)
        self.assertEqual(done[-1], (report.frames, report.frames))

        rig = sigs.read_rig(self.folder / "mine" / f"{self.rig['name']}.rig.json")
        self.assertEqual(list(rig.cameras), list(MOUNTS))
        self.assertEqual(report.frames, sum(len(rig.labels(name)) for name in rig.cameras))
        columns = rig.columns()
        self.assertEqual(columns["frame"].tolist(), list(range(120, 130)))
        ranges_m = [frame.intruders[0].distance_m for frame in rig.labels("front")]
        np.testing.assert_allclose(columns["range_m"], ranges_m, atol=1e-3)  # the front camera is the aircraft's origin
        for time_s, seen_by, late in zip(columns["time_s"], columns["seen_by"], columns["late_visible_fraction"]):
            self.assertEqual(np.isnan(late), time_s < 5 - 0.03, time_s)
            self.assertLessEqual(set(filter(None, seen_by.split("+"))), set(MOUNTS))
        with self.assertRaisesRegex(sigs.UsageError, "front, left, late"):
            rig.labels("up")
        with self.assertRaises(sigs.BadData):
            sigs.read_rig(self.path)
        with self.assertRaises(sigs.CannotRead):
            sigs.read_rig(self.folder / "none.rig.json")


if __name__ == "__main__":
    unittest.main()
