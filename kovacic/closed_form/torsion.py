"""Genus 1 and higher: is int r dx/sqrt(g) elementary?  (to be filled in)"""

from __future__ import annotations

from kovacic.closed_form.curve import CurveIntegral
from kovacic.closed_form.units import Unit


def unit_of_divisor(integral: CurveIntegral) -> Unit | None:
    return None


def open_reason(integral: CurveIntegral) -> str:
    return f"the curve s^2 = {integral.g} has positive genus"
