# SPDX-License-Identifier: MIT
"""Projects: fields, waypoints, files, errors."""

import json
import math
import pickle
import unittest
import warnings

import numpy as np
import support

import sigs


class Fields(support.InFolder):
    def setUp(self):
        super().setUp()
        self.project = sigs.open(support.CROSSING)

    def test_fields_are_those_of_the_file(self):
        document = json.loads(support.CROSSING.read_text())
        self.assertEqual(self.project["camera.speed_mps"], document["camera"]["speed_mps"])
        self.assertEqual(self.project["light.position_m"], document["light"]["position_m"])
        self.assertEqual(self.project["name"], "crossing")
        self.assertIsNone(self.project["footage.last_frame"])
        fields = self.project.fields()
        self.assertEqual(fields["camera.speed_mps"].unit, "m/s")
        self.assertIn("ffv1", fields["export.video.codec"].choices)

    def test_a_set_field_is_read_back_and_saved(self):
        self.project["camera.speed_mps"] = np.float32(30)
        self.project["light.position_m"] = np.array([1, 2, 3])
        self.project["export.video.codec"] = "h264"
        self.project["intruders[0].name"] = "30"
        self.project["export.labels"] = ("xml", "coco")
        self.project.save(self.folder / "p.json")
        document = json.loads((self.folder / "p.json").read_text())
        self.assertEqual(document["camera"]["speed_mps"], 30)
        self.assertEqual(document["light"]["position_m"], [1, 2, 3])
        self.assertEqual(document["export"]["video"]["codec"], "h264")
        self.assertEqual(document["intruders"][0]["name"], "30")
        self.assertEqual(sigs.open(self.folder / "p.json")["export.labels"], ["xml", "coco"])
        with self.assertRaises(sigs.CannotCreate):
            self.project.save(self.folder / "p.json")
        self.project.save(self.folder / "p.json", overwrite=True)

    def test_what_is_no_field_or_of_the_wrong_type_is_an_error_that_names_it(self):
        with self.assertRaises(sigs.UsageError) as caught:
            self.project["camera.sped_mps"] = 3
        self.assertIn("camera.speed_mps", caught.exception.what)
        self.assertEqual(caught.exception.kind, "usage")
        self.assertEqual(str(caught.exception), f"{caught.exception.where}: {caught.exception.what}")
        with self.assertRaisesRegex(sigs.UsageError, "camera.speed_mps"):
            self.project["camera.sped_mps"]
        with self.assertRaisesRegex(sigs.Error, "expected a number"):
            self.project["camera.speed_mps"] = "fast"
        for wrong in (math.nan, math.inf):
            with self.assertRaisesRegex(sigs.UsageError, "camera.speed_mps: expected finite numbers, found"):
                self.project["camera.speed_mps"] = wrong
        self.assertEqual(self.project["camera.speed_mps"], 22)

    def test_a_wrong_value_is_a_problem_and_an_error_when_frames_are_asked_for(self):
        self.project["camera.speed_mps"] = -1e9
        problems = self.project.problems()
        self.assertEqual([problem.field for problem in problems], ["camera.speed_mps"])
        with self.assertRaisesRegex(sigs.BadProject, "camera.speed_mps"):
            self.project.render(0)
        with self.assertRaises(sigs.BadProject):
            self.project.frames()
        self.project["camera.speed_mps"] = 22
        self.assertEqual(self.project.problems(), [])
        self.assertEqual(self.project.render(0).index, 0)

    def test_a_model_that_is_missing_is_named(self):
        self.project.intruders[0]["model.file"] = "none.obj"
        with self.assertRaisesRegex(sigs.CannotRead, "none.obj"):
            self.project.render(0)

    def test_frames_that_there_are_not_are_refused(self):
        for wrong in (-1, 200):
            with self.assertRaisesRegex(sigs.UsageError, "0 to 199"):
                self.project.render(wrong)
        for wrong in ("a", 2.5, None):
            with self.assertRaisesRegex(sigs.UsageError, "frame: expected a whole number, found"):
                self.project.render(wrong)
        for wrong in (range(0), range(0, 10, 2), range(150, 250), [1, 2]):
            with self.assertRaises(sigs.UsageError):
                self.project.frames(wrong)

    def test_unknown_keys_give_a_warning_and_are_kept(self):
        document = json.loads(support.CROSSING.read_text())
        document["colour of the cat"] = "black"
        (self.folder / "p.json").write_text(json.dumps(document))
        with self.assertWarnsRegex(sigs.ProjectWarning, "colour of the cat"):
            project = sigs.open(self.folder / "p.json")
        self.assertEqual(json.loads(project.text())["colour of the cat"], "black")

    def test_files_that_are_no_projects_are_errors(self):
        for text, kind in (("{", sigs.BadProject), ("[1]", sigs.BadProject), ("", sigs.BadProject)):
            (self.folder / "p.json").write_text(text)
            with self.assertRaisesRegex(kind, "p.json"):
                sigs.open(self.folder / "p.json")
        with self.assertRaises(sigs.CannotRead):
            sigs.open(self.folder / "missing.json")
        with self.assertRaises(sigs.Error):
            sigs.Video(self.folder / "p.json")


class Intruders(unittest.TestCase):
    def setUp(self):
        self.project = sigs.open(support.CROSSING)
        self.intruder = self.project.intruders[0]

    def test_waypoints_are_arrays_of_frames_and_positions(self):
        frames, positions_m = self.intruder.waypoints
        np.testing.assert_array_equal(frames, [0, 100, 199])
        np.testing.assert_array_equal(positions_m[1], [540, 0, -225])
        self.intruder.waypoints = (None, positions_m[:2])
        frames, positions_m = self.intruder.waypoints
        self.assertTrue(np.isnan(frames).all())
        self.assertEqual(positions_m.shape, (2, 3))
        np.testing.assert_allclose(self.project.render(0).truth.intruder(0).position_m, [420, -330, -65], atol=1e-9)

    def test_waypoints_of_the_wrong_shape_are_refused(self):
        for wrong in ((None, [1, 2, 3]), ([1], [[1, 2, 3], [4, 5, 6]]), (None, [[1, 2]])):
            with self.assertRaisesRegex(sigs.UsageError, "waypoints"):
                self.intruder.waypoints = wrong
        self.assertEqual(len(self.intruder.waypoints.frames), 3)

    def test_waypoints_out_of_order_are_a_problem(self):
        frames, positions_m = self.intruder.waypoints
        self.intruder.waypoints = (frames[::-1], positions_m)
        self.assertTrue(any("waypoints" in problem.field for problem in self.project.problems()))

    def test_an_added_intruder_flies_and_a_removed_one_does_not(self):
        model = support.SOURCE / "assets/models/light-aircraft/light-aircraft.obj"
        added = self.project.add_intruder(name="second", model=model)
        added.waypoints = ([0], [[300, 20, -150]])
        self.assertEqual(len(self.project.render(0).truth.intruders), 2)
        self.assertIsNotNone(self.project.render(0).truth.intruder("second").box)
        self.project.remove_intruder("airliner")
        self.assertEqual([one.name for one in self.project.intruders], ["second"])
        self.assertEqual(len(self.project.render(0).truth.intruders), 1)
        with self.assertRaises(sigs.UsageError):
            self.project.add_intruder(nme="third")
        self.assertEqual(len(self.project.intruders), 1)

    def test_a_copy_and_a_pickled_project_are_the_same_and_independent(self):
        for other in (self.project.copy(), pickle.loads(pickle.dumps(self.project))):
            self.assertEqual(other.text(), self.project.text())
            self.assertEqual(support.samples(other.render(99)), support.samples(self.project.render(99)))
            other["camera.speed_mps"] = 1
            self.assertEqual(self.project["camera.speed_mps"], 22)

    def test_closing_frees_and_the_next_frame_opens_again(self):
        before = support.samples(self.project.render(100))
        self.project.close()
        self.project.close()
        self.assertEqual(support.samples(self.project.render(100)), before)


class Encounters(unittest.TestCase):
    def test_iterated_frames_have_the_encounter_that_the_project_asks_for(self):
        project = sigs.open(support.CROSSING)
        project["export.encounter"] = ["nmac"]
        encounter = next(project.frames(range(100, 101))).truth.intruder(0).encounter
        self.assertEqual([one.volume for one in encounter.well_clear], ["nmac"])
        self.assertAlmostEqual(encounter.closing_speed_mps, -encounter.range_rate_mps)
        self.assertIsNone(project.render(100).truth.intruder(0).encounter)


if __name__ == "__main__":
    warnings.simplefilter("ignore", sigs.ProjectWarning)
    unittest.main()
