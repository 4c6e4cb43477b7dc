# SPDX-License-Identifier: MIT
"""Label files read back: against the file itself, against another format, and broken ones."""

import math
import unittest
import xml.etree.ElementTree as ElementTree

import numpy as np
import support

import sigs


class ReadLabels(support.InFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.project = sigs.open(support.SOURCE / "projects/two-intruders/two-intruders.json")
        cls.project["export.labels"] = ["xml", "coco"]
        cls.project["export.encounter"] = ["dwc-en-route", "nmac"]
        cls.project["name"] = "two"

    def setUp(self):
        super().setUp()
        sigs.export(self.project, self.folder, frames=range(40, 52))
        self.labels = sigs.read_labels(self.folder / "two.xml")

    def test_every_number_of_the_file_is_there(self):
        root = ElementTree.parse(self.folder / "two.xml").getroot()
        self.assertEqual(self.labels.video, root.find("footage").get("video"))
        self.assertEqual(self.labels.size_px, (1280, 960))
        self.assertEqual(self.labels.frame_rate, (25, 1))
        for node, frame in zip(root.findall("frame"), self.labels, strict=True):
            self.assertEqual((int(node.get("index")), float(node.get("time_s"))), (frame.index, frame.time_s))
            camera = node.find("camera")
            self.assertEqual([float(camera.get(k)) for k in ("x_m", "y_m", "z_m")], list(frame.camera.position_m))
            for one, truth in zip(node.findall("intruder"), frame.intruders, strict=True):
                self.assertEqual((int(one.get("id")), one.get("name")), (truth.id, truth.name))
                self.assertEqual(float(one.find("distance").get("m")), truth.distance_m)
                self.assertEqual(one.find("box") is None, truth.box is None)
                if truth.box:
                    self.assertEqual([int(one.find("box").get(k)) for k in ("x", "y", "width", "height")], list(truth.box))
                    self.assertEqual(int(one.find("box").get("pixels")), truth.pixels)
                encounter = one.find("encounter")
                self.assertEqual(float(encounter.get("hmd_m")), truth.encounter.hmd_m)
                self.assertEqual([v.get("volume") for v in encounter], [v.volume for v in truth.encounter.well_clear])

    def test_the_coco_file_says_the_same_of_visible_intruders(self):
        coco = sigs.read_labels(self.folder / "two.coco.json")
        self.assertEqual([frame.index for frame in coco], [frame.index for frame in self.labels])
        boxes = 0
        for other, frame in zip(coco, self.labels, strict=True):
            self.assertEqual([one.id for one in other.intruders], [one.id for one in frame.visible])
            for one in other.intruders:
                truth = frame.intruder(one.id)
                self.assertEqual((one.name, one.box, one.pixels), (truth.name, truth.box, truth.pixels))
                self.assertEqual((one.position_m, one.attitude_deg), (truth.position_m, truth.attitude_deg))
                self.assertEqual(one.appearance, truth.appearance)
                np.testing.assert_allclose(one.silhouette, truth.silhouette, atol=1e-4)
                boxes += 1
        self.assertGreater(boxes, 5)
        self.assertTrue(math.isnan(coco[0].camera.position_m[0]))

    def test_columns_have_a_row_for_each_intruder_in_each_frame(self):
        columns = self.labels.columns()
        self.assertTrue(all(len(column) == 24 for column in columns.values()))
        row = 2 * 7 + 1
        truth = self.labels[7].intruders[1]
        self.assertEqual((columns["frame"][row], columns["id"][row], columns["name"][row]), (47, 1, truth.name))
        np.testing.assert_array_equal(columns["position_m"][row], truth.position_m)
        np.testing.assert_array_equal(columns["box"][row], truth.box or (0, 0, 0, 0))
        self.assertEqual(columns["row"][row], 7)

    def test_frames_are_found_by_their_number_in_the_footage(self):
        self.assertIs(self.labels.frame(45), self.labels[5])
        for missing in (39, 52):
            with self.assertRaises(KeyError):
                self.labels.frame(missing)

    def test_a_label_file_without_frames_has_empty_columns(self):
        text = (self.folder / "two.xml").read_text()
        start, end = text.index("  <frame "), text.rindex("</frame>") + len("</frame>")
        (self.folder / "none.xml").write_text(text[:start] + text[end:])
        labels = sigs.read_labels(self.folder / "none.xml")
        self.assertEqual(len(labels), 0)
        self.assertEqual(labels.columns()["position_m"].shape, (0, 3))

    def test_files_cut_off_anywhere_are_errors_that_name_the_file(self):
        for name in ("two.xml", "two.coco.json"):
            whole = (self.folder / name).read_bytes().rstrip()
            for length in (*range(0, 300, 7), *range(300, len(whole), len(whole) // 60)):
                (self.folder / "cut").write_bytes(whole[:length])
                with self.assertRaisesRegex(sigs.BadData, "cut"):
                    sigs.read_labels(self.folder / "cut")

    def test_an_element_that_is_missing_or_no_number_is_named_with_its_frame(self):
        text = (self.folder / "two.xml").read_text()
        for old, new, word in (
            ("<camera ", "<kamera ", "camera"),
            ('time_s="1.6"', 'time_s="late"', "late"),
            ('id="0"', 'id="first"', "first"),
            ("<footage ", "<film ", "video"),
            ('in_picture="', 'in_sight="', "in_picture"),
        ):
            self.assertIn(old, text)
            (self.folder / "bad.xml").write_text(text.replace(old, new, 1).replace("frame_rate=\"25/1\"/>", "/>"))
            with self.assertRaisesRegex(sigs.BadData, word):
                sigs.read_labels(self.folder / "bad.xml")

    def test_a_file_that_is_not_there_cannot_be_read(self):
        with self.assertRaisesRegex(sigs.CannotRead, "nowhere.xml"):
            sigs.read_labels(self.folder / "nowhere.xml")


if __name__ == "__main__":
    unittest.main()
