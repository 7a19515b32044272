from __future__ import annotations

import pickle

import pytest

from statorhom.study.frozen_map import FrozenMap


def test_is_a_mapping_with_frozen_inner_maps() -> None:
    frozen = FrozenMap({"a": {"b": 1.0}})
    assert frozen == {"a": {"b": 1.0}}
    assert isinstance(frozen["a"], FrozenMap)
    assert frozen.plain() == {"a": {"b": 1.0}} and isinstance(frozen.plain()["a"], dict)


def test_does_not_follow_its_source() -> None:
    source = {"a": 1}
    frozen = FrozenMap(source)
    source["a"] = 2
    assert frozen["a"] == 1


def test_equal_maps_have_equal_hashes_in_any_order() -> None:
    assert hash(FrozenMap({"a": 1, "b": 2})) == hash(FrozenMap({"b": 2, "a": 1}))


def test_cannot_be_changed_but_pickled() -> None:
    frozen = FrozenMap({"a": {"b": 1}})
    with pytest.raises(AttributeError):
        frozen._items = {}
    with pytest.raises(TypeError):
        frozen["a"] = 2
    assert pickle.loads(pickle.dumps(frozen)) == frozen
