# SPDX-License-Identifier: MIT
"""Rendering with poses and waypoints that change from frame to frame."""

import unittest
import xml.etree.ElementTree as ElementTree

import numpy as np
import support

import sigs

AHEAD = np.array([3000.0, 0.0, -150.0])  # so far that the aircraft is nearly a point


def lens():
    """Camera matrix and k1 k2 k3 k4 of the sample's calibration file, a fisheye's."""
    root = ElementTree.parse(support.SOURCE / "assets/calibrations/sample.xml").getroot()

    def numbers(name):
        return np.array([float(text) for text in root.find(name).find("data").text.split()])

    return numbers("camera_matrix").reshape(3, 3), numbers("distortion_coefficients")


def pixel(p_in_camera):
    """The pixel of a point in the camera frame by Kannala and Brandt's formula, as cv::fisheye::projectPoints has it."""
    matrix, k = lens()
    x, y = p_in_camera[1] / p_in_camera[0], p_in_camera[2] / p_in_camera[0]
    r = np.hypot(x, y)
    theta = np.arctan(r)
    bent = theta * (1 + k @ theta ** np.array([2, 4, 6, 8]))
    scale = bent / r if r > 0 else 1.0
    return np.array([matrix[0, 0] * scale * x + matrix[0, 2], matrix[1, 1] * scale * y + matrix[1, 2]])


def middle(silhouette):
    return np.array([silhouette.x + silhouette.width / 2, silhouette.y + silhouette.height / 2])


class ClosedLoop(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.project = sigs.open(support.CROSSING)
        cls.project["camera.speed_mps"] = 0

    def at(self, position_m, number=20, **more):
        return self.project.render(number, poses={"airliner": sigs.Pose(position_m, (0, 0, 90))}, **more)

    def test_a_given_position_appears_where_the_lens_has_it(self):
        for offset in ([0, 0, 0], [0, 500, 0], [0, -700, 200], [0, 300, -400]):
            position = AHEAD + offset
            truth = self.at(position).truth.intruder("airliner")
            np.testing.assert_allclose(truth.position_m, position - [0, 0, -150], atol=1e-9)
            # The middle of the silhouette is some metres from the model's reference point, at 0.2 px a metre.
            np.testing.assert_allclose(middle(truth.silhouette), pixel(truth.position_m), atol=0.8)

    def test_a_moved_intruder_moves_in_the_image_as_the_lens_predicts(self):
        before = self.at(AHEAD).truth.intruder(0)
        for step in ([0, 40, 0], [0, -250, 0], [0, 0, 120], [0, 200, -150]):
            after = self.at(AHEAD + step).truth.intruder(0)
            moved = middle(after.silhouette) - middle(before.silhouette)
            predicted = pixel(after.position_m) - pixel(before.position_m)
            # Only the side from which it is seen changes besides: some degrees of an aircraft of 7 px.
            np.testing.assert_allclose(moved, predicted, atol=0.2)
            self.assertGreater(np.linalg.norm(moved), 5)

    def test_the_box_follows_and_the_image_changes_there_alone(self):
        plain = self.at([-100, 0, -150])  # behind the camera
        self.assertIsNone(plain.truth.intruder(0).box)
        self.assertEqual(plain.mask.max(), 0)
        frame = self.at(AHEAD + [0, 200, 0])
        changed = frame.planes[0] != plain.planes[0]
        self.assertTrue(changed.any())
        self.assertFalse(changed[frame.mask == 0].any())
        box = frame.truth.intruder(0).box
        self.assertGreater(np.count_nonzero(frame.visible(0)[box.slices]), 10)

    def test_the_poses_of_the_project_itself_give_its_own_frame(self):
        project = sigs.open(support.CROSSING)
        own = project.render(100)
        truth = own.truth.intruder(0)
        # The camera has no attitude, so its axes are the world's.
        position = np.array(own.truth.camera.position_m) + truth.position_m
        given = project.render(
            100,
            poses={0: sigs.Pose(position, truth.attitude_deg)},
            camera=sigs.Pose(own.truth.camera.position_m, own.truth.camera.attitude_deg),
        )
        self.assertLessEqual(np.abs(given.planes[0].astype(int) - own.planes[0]).max(), 1)
        self.assertEqual(given.truth.intruder(0).box, truth.box)
        self.assertEqual(support.samples(project.render(100)), support.samples(own))

    def test_camera_and_intruder_moved_alike_give_the_same_image(self):
        position = np.array([600.0, 30, -170])
        shift = np.array([1000.0, -2000, -300])
        self.project["light.kind"] = "sun"
        try:
            self.project["light.sun.azimuth_deg"] = 40
            self.project["light.sun.elevation_deg"] = 30
            first = self.at(position, camera=([0, 0, -150],))
            second = self.at(position + shift, camera=(shift + [0, 0, -150],))
        finally:
            self.project["light.kind"] = "point"
        self.assertEqual(support.samples(first), support.samples(second))

    def test_a_camera_turned_to_the_right_sees_the_intruder_farther_left(self):
        ahead = self.at(AHEAD, camera=([0, 0, -150], (0, 0, 0))).truth.intruder(0)
        turned = self.at(AHEAD, camera=([0, 0, -150], (0, 0, 5))).truth
        angle = np.radians(5)
        expected = 3000 * np.array([np.cos(angle), -np.sin(angle), 0])
        np.testing.assert_allclose(turned.intruder(0).position_m, expected, atol=1e-9)
        self.assertLess(middle(turned.intruder(0).silhouette)[0], middle(ahead.silhouette)[0] - 30)
        np.testing.assert_allclose(turned.camera.attitude_deg, (0, 0, 5), atol=1e-9)

    def test_a_moved_waypoint_moves_the_intruder(self):
        project = sigs.open(support.CROSSING)
        before = project.render(100).truth.intruder(0)
        frames, positions_m = project.intruders[0].waypoints
        project.intruders[0].waypoints = (frames, positions_m + [0, 0, -30])
        after = project.render(100).truth.intruder(0)
        np.testing.assert_allclose(np.subtract(after.position_m, before.position_m), [0, 0, -30], atol=1e-9)

    def test_exposure_blurs_along_a_given_velocity(self):
        project = sigs.open(support.CROSSING)
        project["camera.speed_mps"] = 0
        project["camera.exposure_s"] = 0.02
        at = [600, 0, -150]
        still = project.render(20, poses={0: (at, (0, 0, 90))}).truth.intruder(0).appearance
        fast = project.render(20, poses={0: (at, (0, 0, 90), (0, 200, 0))}).truth.intruder(0).appearance
        self.assertEqual(still.motion_blur_px, 0)
        expected = pixel([600, 2, 0]) - pixel([600, -2, 0])  # 4 m while the shutter is open
        self.assertAlmostEqual(fast.motion_blur_px, float(np.linalg.norm(expected)), places=2)

    def test_what_is_given_wrongly_is_an_error_that_says_what(self):
        for poses, word in (
            ({"airliner": ([0, 0], (0, 0, 0))}, "three numbers"),
            ({"airliner": ([np.nan, 0, 0],)}, "1e8 m"),
            ({"airliner": ([0, 0, 0], (0, np.inf, 0))}, "finite"),
            ({"airliner": ([0, 0, 0], (0, 0, 0), (0, 0, 1e9))}, "velocity"),
            ({"airliner": 7}, "sigs.Pose"),
        ):
            with self.assertRaisesRegex(sigs.UsageError, word):
                self.project.render(0, poses=poses)
        with self.assertRaises(KeyError):
            self.project.render(0, poses={"zeppelin": ([0, 0, 0],)})


if __name__ == "__main__":
    unittest.main()
