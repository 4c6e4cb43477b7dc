# SPDX-License-Identifier: MIT
"""The manual's examples run, are those of the page, and everything is typed and documented."""

import importlib.util
import inspect
import re
import subprocess
import sys
import unittest

import support

import sigs

EXAMPLES = sorted((support.SOURCE / "docs/examples/python").glob("*.py"))
PAGE = support.SOURCE / "docs/python.md"
REFERENCE = support.SOURCE / "docs/python-reference.md"


def has(module):
    return importlib.util.find_spec(module) is not None


class Manual(support.InFolder):
    def run_example(self, name, *arguments):
        command = [sys.executable, str(support.SOURCE / "docs/examples/python" / name), *map(str, arguments)]
        return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True, cwd=self.folder).stdout

    def test_the_pages_have_each_example_word_for_word(self):
        pages = PAGE.read_text() + REFERENCE.read_text()
        blocks = re.findall(r"```python\n(.*?)```", pages, re.DOTALL)
        for example in EXAMPLES:
            self.assertIn(example.read_text(), blocks, example.name)

    def test_the_short_pieces_of_the_page_run(self):
        blocks = [b for b in re.findall(r"```python\n(.*?)```", PAGE.read_text(), re.DOTALL) if "SPDX" not in b]
        self.assertGreater(len(blocks), 2)
        names = {"path": str(support.CROSSING), "folder": str(self.folder)}
        for block in blocks:
            exec(compile(block, str(PAGE), "exec"), names)  # one after the other, as they are read

    def test_the_frames_example_says_where_the_intruder_is(self):
        lines = self.run_example("frames.py", support.CROSSING).splitlines()
        self.assertEqual([line.split()[0] for line in lines], [str(n) for n in range(90, 100)])

    def test_the_labels_example_reads_an_exported_folder(self):
        sigs.export(sigs.open(support.CROSSING), self.folder / "out", frames=range(95, 100))
        said = self.run_example("labels.py", self.folder / "out", "crossing")
        self.assertIn("5 frames of sample.mp4, 5 boxes", said)
        self.assertIn("95 airliner", said)

    def test_the_loop_of_the_example_brings_the_intruder_to_the_middle(self):
        lines = self.run_example("closed_loop.py", support.CROSSING).splitlines()
        errors_px = [abs(float(line.split()[2])) for line in lines]
        self.assertEqual(len(errors_px), 40)
        self.assertLess(errors_px[-1], 25)  # it lags behind a target that crosses
        self.assertLess(errors_px[-1], errors_px[0] / 4)

    @unittest.skipUnless(has("torch"), "PyTorch (python3-torch) is absent")
    def test_the_data_set_feeds_a_loader_with_workers(self):
        self.assertIn("torch.Size([4, 3, 960, 1280])", self.run_example("torch_dataset.py", support.CROSSING))

    @unittest.skipUnless(has("torch"), "PyTorch (python3-torch) is absent")
    def test_a_model_takes_a_step_on_a_batch_of_it(self):
        import torch
        from torch.utils.data import DataLoader

        sys.path.insert(0, str(support.SOURCE / "docs/examples/python"))
        from torch_dataset import Encounter

        data = Encounter(str(support.CROSSING))
        data.project.render(0)  # OpenGL is in use before the workers are forked
        self.assertEqual(len(data), 200)
        model = torch.nn.Conv2d(3, 1, 3, stride=8)
        for batch in DataLoader(torch.utils.data.Subset(data, [99, 100, 101]), batch_size=3, num_workers=1):
            loss = model(batch["image"]).mean()
            loss.backward()
            self.assertEqual(batch["boxes"].shape, (3, 1, 4))
            self.assertEqual(batch["frame"].tolist(), [99, 100, 101])
        self.assertGreater(float(model.weight.grad.abs().sum()), 0)


class Types(support.InFolder):
    @unittest.skipUnless(has("mypy"), "mypy is absent")
    def test_the_package_and_the_examples_pass_mypy_strict(self):
        # PyTorch's own sources are not read: that takes minutes.
        settings = self.folder / "mypy.ini"
        settings.write_text(
            "[mypy]\nstrict = True\ndisallow_subclassing_any = False\nfollow_imports = silent\n"
            "[mypy-torch.*]\nfollow_imports = skip\nignore_missing_imports = True\n"
        )
        environment = {"MYPYPATH": str(support.SOURCE / "python"), "PATH": "/usr/bin:/bin"}
        command = [sys.executable, "-m", "mypy", f"--config-file={settings}", f"--cache-dir={self.folder}"]
        for checked in (["-p", "sigs"], [str(example) for example in EXAMPLES]):
            done = subprocess.run([*command, *checked], env=environment, stdout=subprocess.PIPE, text=True)
            self.assertEqual(done.returncode, 0, done.stdout)

    def test_the_stub_describes_everything_of_the_extension(self):
        stub = (support.SOURCE / "python/sigs/_sigs.pyi").read_text()
        for name, thing in vars(sys.modules["sigs._sigs"]).items():
            if name.startswith("__"):
                continue
            self.assertRegex(stub, rf"(class|def) {name}\b")
            if inspect.isclass(thing):
                of_class = stub[stub.index(f"class {name}") :].split("\nclass ")[0]
                for member in vars(thing):
                    if not member.startswith("_"):
                        self.assertRegex(of_class, rf"def {member}\b", name)

    def test_everything_public_has_a_description(self):
        for name in sigs.__all__:
            thing = getattr(sigs, name)
            if name.startswith("__"):
                continue
            self.assertTrue(inspect.getdoc(thing), name)
            for member, value in vars(thing).items() if inspect.isclass(thing) else ():
                if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                    self.assertTrue(inspect.getdoc(value), f"{name}.{member}")


if __name__ == "__main__":
    unittest.main()
