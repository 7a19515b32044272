"""``[stages.identify.response_surface]``: design of experiments and surface of the method of that name."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from statorhom.study.keys import Keys, Positive, WholeNumber


class SurfaceKeys(Keys):
    """How the constants are sampled and what is fitted to the samples.

    ``design`` places the points, ``points`` says how many a Latin hypercube has at first, ``surface`` is fitted to
    them; ``degree`` of a polynomial is chosen by its predictions unless given. The design grows until the surface
    predicts every mode to ``largest_error_percent`` at points that it was not fitted to, or ``most_points`` are
    reached.
    """

    design: Literal["latin_hypercube", "full_factorial", "sparse_grid"] = "latin_hypercube"
    points: Annotated[WholeNumber, Field(ge=2, le=4096)] | None = None
    surface: Literal["gaussian_process", "polynomial"] = "gaussian_process"
    degree: Annotated[WholeNumber, Field(ge=1, le=6)] | None = None
    largest_error_percent: Annotated[Positive, Field(le=50)] = 3.0
    most_points: Annotated[WholeNumber, Field(ge=3, le=4096)] = 300

    @model_validator(mode="after")
    def _belong_together(self) -> SurfaceKeys:
        if self.degree is not None and self.surface != "polynomial":
            raise ValueError(
                'degree: only a polynomial has one; leave it out or write surface = "polynomial"'
            )
        if self.points is not None and self.design != "latin_hypercube":
            raise ValueError("points: only a latin_hypercube has any number of them; leave it out")
        if self.points is not None and self.points > self.most_points:
            raise ValueError(
                f"points: {self.points} are more than most_points = {self.most_points}; raise that one"
            )
        return self
