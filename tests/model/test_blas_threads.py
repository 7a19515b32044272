"""The limit of BLAS threads."""

from threadpoolctl import threadpool_info

from statorhom.model.blas_threads import one_blas_thread


def threads():
    return [library["num_threads"] for library in threadpool_info() if library["user_api"] == "blas"]


def test_one_thread_within_and_as_before_afterwards():
    before = threads()
    assert before
    for _ in range(2):
        with one_blas_thread():
            assert set(threads()) == {1}
        assert threads() == before
