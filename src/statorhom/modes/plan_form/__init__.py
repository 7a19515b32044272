"""Names of the shapes of plates, beams and wings: bodies without circumferential order."""

from statorhom.modes.plan_form.frame import PlanForm, plan_form
from statorhom.modes.plan_form.name import PlanFormName, name_plan_form, ordinal_labels

__all__ = ["PlanForm", "PlanFormName", "name_plan_form", "ordinal_labels", "plan_form"]
