# SPDX-License-Identifier: MIT
"""Frames through Python are the frames that an export writes."""

import gc
import shutil
import subprocess
import unittest

import numpy as np
import support

import sigs

FRAMES = range(95, 107)


def resident_bytes():
    with open("/proc/self/statm", encoding="ascii") as statm:
        return int(statm.read().split()[1]) * 4096


class FramesAndExport(support.InFolder):
    def setUp(self):
        super().setUp()
        support.exported(support.CROSSING, self.folder, "--frames", f"{FRAMES[0]}-{FRAMES[-1]}")
        self.project = sigs.open(support.CROSSING)

    def test_iterated_frames_have_the_bytes_of_the_exported_video_for_any_number_of_jobs(self):
        video = support.decoded(self.folder / "crossing.mkv", "yuv420p")
        for jobs in (1, 3):
            self.assertEqual(b"".join(support.samples(f) for f in self.project.frames(FRAMES, jobs=jobs)), video)

    def test_frames_rendered_one_by_one_in_any_order_have_the_same_bytes(self):
        video = support.decoded(self.folder / "crossing.mkv", "yuv420p")
        size = len(video) // len(FRAMES)
        for number in (*reversed(FRAMES), FRAMES[0]):
            start = (number - FRAMES[0]) * size
            self.assertEqual(support.samples(self.project.render(number)), video[start : start + size])

    def test_masks_are_those_of_the_exported_masks(self):
        masks = support.decoded(self.folder / "crossing.masks.mkv", "gray")
        self.assertEqual(b"".join(f.mask.tobytes() for f in self.project.frames(FRAMES)), masks)
        self.assertGreater(max(masks), 0)

    def test_the_truth_is_that_of_the_label_file(self):
        labels = sigs.read_labels(self.folder / "crossing.xml")
        self.assertEqual([frame.index for frame in labels], list(FRAMES))
        for frame in self.project.frames(FRAMES):
            self.assertEqual(rounded(frame.truth), rounded(labels.frame(frame.index)))
            self.assertEqual(frame.truth.index, frame.index)
            self.assertEqual(frame.truth.time_s, frame.time_s)

    def test_lights_clouds_and_contrails_are_those_of_the_label_file(self):
        self.project["name"] = "seen"
        for key, value in {
            "intruders[0].contrail.strands": 2,
            "intruders[0].lights.landing_cd": 400000,
            "intruders[0].lights.position_cd": 40000,
            "footage.cloud_distance_m": 100,
            "appearance.haze.visibility_m": 9000,
        }.items():
            self.project[key] = value
        sigs.export(self.project, self.folder / "seen", frames=FRAMES)
        labels = sigs.read_labels(self.folder / "seen/seen.xml")
        kinds = set()
        for frame in self.project.frames(FRAMES):
            self.assertEqual(rounded(frame.truth), rounded(labels.frame(frame.index)))
            for one in frame.truth.visible:
                kinds |= {"light"} if one.lights else set()
                kinds |= {"clouds"} if one.clouds else set()
                kinds |= {"contrail"} if one.contrail else set()
                kinds |= {"haze"} if one.appearance.visibility_m == 9000 else set()
        self.assertEqual(kinds, {"light", "clouds", "contrail", "haze"})

    def test_the_export_of_the_module_writes_the_files_of_the_program(self):
        done = []
        report = sigs.export(self.project, self.folder / "mine", frames=FRAMES, progress=lambda n, of: done.append((n, of)))
        self.assertEqual(report.frames, len(FRAMES))
        self.assertEqual(done[-1], (len(FRAMES), len(FRAMES)))
        for file in report.written:
            self.assertEqual(file.read_bytes(), (self.folder / file.name).read_bytes(), file)

    def test_images_have_the_times_that_are_stated(self):
        images = self.folder / "images"
        images.mkdir()
        command = ["ffmpeg", "-v", "error", "-i", str(self.folder / "crossing.mkv"), "-frames:v", "5", str(images / "%d.png")]
        if shutil.which("ffmpeg") is None:
            self.skipTest("ffmpeg is absent")
        subprocess.run(command, check=True)
        (self.folder / "times.txt").write_text("0\n0.05\n0.2\n0.7\n0.8\n")
        np.testing.assert_allclose(sigs.Video(images).times_s, np.arange(5) / 25)
        np.testing.assert_allclose(sigs.Video(images, frame_rate=10).times_s, np.arange(5) / 10)
        listed = sigs.Video(images, timestamps=self.folder / "times.txt")
        np.testing.assert_allclose(listed.times_s, [0, 0.05, 0.2, 0.7, 0.8])
        with self.assertRaises(ValueError):
            sigs.Video(images, frame_rate=0)

    def test_a_video_gives_the_images_of_the_file_by_number(self):
        video = sigs.Video(self.folder / "crossing.mkv")
        self.assertEqual((len(video), video.size_px, video.layout, video.codec), (len(FRAMES), (1280, 960), "yuv420", "ffv1"))
        np.testing.assert_array_equal(video[3], self.project.render(FRAMES[3]).rgb)
        np.testing.assert_array_equal(video[-1], self.project.render(FRAMES[-1]).rgb)
        masks = sigs.Video(self.folder / "crossing.masks.mkv")
        np.testing.assert_array_equal(masks[3], self.project.render(FRAMES[3]).mask)
        with self.assertRaises(IndexError):
            video[len(FRAMES)]


def rounded(value):
    """With the digits that the label file has: six after the point, four of a silhouette."""
    if isinstance(value, sigs.Silhouette):
        return tuple(round(side, 4) + 0.0 for side in value)
    if isinstance(value, float):
        return round(value, 6) + 0.0
    if isinstance(value, tuple):
        return tuple(rounded(one) for one in value)
    if hasattr(value, "__dataclass_fields__"):
        return {name: rounded(getattr(value, name)) for name in value.__dataclass_fields__}
    return value


class Arrays(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.project = sigs.open(support.CROSSING)

    def address(self, array):
        return array.__array_interface__["data"][0]

    def test_planes_and_mask_are_the_frames_own_samples(self):
        frame = self.project.render(100)
        for first, second in zip(frame.planes, frame.planes):
            self.assertEqual(self.address(first), self.address(second))
            self.assertFalse(first.flags.owndata)
            self.assertEqual(first.dtype, np.uint8)
        self.assertEqual(self.address(frame.mask), self.address(frame.mask))
        self.assertEqual([plane.shape for plane in frame.planes], [(960, 1280), (480, 640), (480, 640)])
        frame.planes[0][5, 7] = 77
        self.assertEqual(frame.planes[0][5, 7], 77)

    def test_an_array_outlives_its_frame(self):
        plane = self.project.render(100).planes[0]
        before = plane.copy()
        gc.collect()
        for number in range(90, 96):
            self.project.render(number)
        np.testing.assert_array_equal(plane, before)

    def test_rgb_and_bgr_are_the_same_image(self):
        frame = self.project.render(100)
        np.testing.assert_array_equal(frame.rgb, frame.bgr[:, :, ::-1])
        self.assertIs(frame.image.dtype, frame.rgb.dtype)
        self.assertEqual(frame.rgb.shape, (960, 1280, 3))

    def test_visible_pixels_are_as_many_as_the_truth_counts_and_lie_in_its_box(self):
        frame = self.project.render(100)
        truth = frame.truth.intruder("airliner")
        visible = frame.visible(truth.id)
        self.assertEqual(np.count_nonzero(visible), truth.pixels)
        self.assertEqual(np.count_nonzero(visible[truth.box.slices]), truth.pixels)
        with self.assertRaises(IndexError):
            frame.visible(9)

    def test_memory_does_not_grow_over_500_frames(self):
        def pass_over(count):
            for number in range(count):
                frame = self.project.render(number % 3)
                self.assertEqual(frame.mask.shape, (960, 1280))
                self.assertEqual(len(frame.planes), 3)

        pass_over(50)  # caches fill
        before = resident_bytes()
        pass_over(500)
        self.assertLess(resident_bytes() - before, 20 << 20)  # a single kept plane of each would be 600 MB

    def test_iteration_can_end_early_and_be_closed(self):
        with self.project.frames(range(0, 200), jobs=2) as frames:
            self.assertEqual(len(frames), 200)
            self.assertEqual(next(frames).index, 0)
        with self.assertRaises(StopIteration):
            next(frames)


class ManyIntruders(unittest.TestCase):
    def test_each_intruder_has_its_own_visible_pixels(self):
        project = sigs.open(support.SOURCE / "projects/two-intruders/two-intruders.json")
        for number in (0, 60, 120):
            frame = project.render(number)
            for truth in frame.truth.visible:
                self.assertEqual(np.count_nonzero(frame.visible(truth.id)), truth.pixels)


if __name__ == "__main__":
    unittest.main()
