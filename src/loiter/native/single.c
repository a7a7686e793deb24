/* The extension module `loiter.compiled.single`: functions of single states. It does not need NumPy. */
#define PY_SSIZE_T_CLEAN
#include <Python.h>

#include "loiter.h"

#define TEXT(name) #name
#define EXPANDED_TEXT(name) TEXT(name)

static PyObject *optimum(PyObject *module, PyObject *args) {
    double x, y, R, tolerance;
    int side;
    loiter_entry entry;
    (void)module;
    if (!PyArg_ParseTuple(args, "dddid", &x, &y, &R, &side, &tolerance)) {
        return NULL;
    }
    if (loiter_optimum(x, y, R, side, tolerance, &entry) != 0) {
        Py_RETURN_NONE;
    }
    return Py_BuildValue("(iiddd)", entry.side, entry.word, entry.t1, entry.t2, entry.t3);
}

static int is_problem(PyObject *args, loiter_wind_problem *p) {
    return PyArg_ParseTuple(args, "dddddiddd", &p->x, &p->y, &p->c, &p->s, &p->R, &p->side, &p->wx, &p->wy,
                            &p->tolerance);
}

static PyObject *tuple_of(loiter_wind_entry e) {
    return Py_BuildValue("(iiiddddd)", e.status, e.side, e.word, e.t1, e.t2, e.t3, e.azimuth, e.miss);
}

static PyObject *fastest_in_wind(PyObject *module, PyObject *args) {
    loiter_wind_problem problem;
    loiter_wind_entry entry;
    (void)module;
    if (!is_problem(args, &problem)) {
        return NULL;
    }
    Py_BEGIN_ALLOW_THREADS
    entry = loiter_fastest_in_wind(&problem);
    Py_END_ALLOW_THREADS
    return tuple_of(entry);
}

static PyObject *first_in_slot_of(PyObject *module, PyObject *args) {
    loiter_wind_problem p;
    loiter_wind_entry entry;
    double phase;
    (void)module;
    if (!PyArg_ParseTuple(args, "dddddidddd", &p.x, &p.y, &p.c, &p.s, &p.R, &p.side, &p.wx, &p.wy, &p.tolerance,
                          &phase)) {
        return NULL;
    }
    Py_BEGIN_ALLOW_THREADS
    entry = loiter_first_in_slot(&p, phase);
    Py_END_ALLOW_THREADS
    return tuple_of(entry);
}

static PyObject *local_minima_in_wind(PyObject *module, PyObject *args) {
    loiter_wind_problem problem;
    loiter_wind_entry entries[LOITER_SAMPLES];
    int count;
    (void)module;
    if (!is_problem(args, &problem)) {
        return NULL;
    }
    Py_BEGIN_ALLOW_THREADS
    count = loiter_local_minima(&problem, entries);
    Py_END_ALLOW_THREADS
    PyObject *found = PyList_New(count);
    for (int i = 0; found != NULL && i < count; i++) {
        PyObject *one = tuple_of(entries[i]);
        if (one == NULL) {
            Py_CLEAR(found);
        } else {
            PyList_SET_ITEM(found, i, one);
        }
    }
    return found;
}

static PyMethodDef FUNCTIONS[] = {
    {"optimum", optimum, METH_VARARGS, "`synthesis.optimum`: the fields of an `Entry`; None where there is none."},
    {"fastest_in_wind", fastest_in_wind, METH_VARARGS, "`wind_search.fastest`: the fields of a `WindEntry`."},
    {"local_minima_in_wind", local_minima_in_wind, METH_VARARGS, "`wind_search.local_minima`: a list of such fields."},
    {"first_in_slot", first_in_slot_of, METH_VARARGS, "`slots.first_in_slot`: the fields of a `WindEntry`."},
    {NULL, NULL, 0, NULL},
};

static struct PyModuleDef DEFINITION = {
    PyModuleDef_HEAD_INIT, "single", "The kernel for single states.", -1, FUNCTIONS, NULL, NULL, NULL, NULL,
};

PyMODINIT_FUNC PyInit_single(void) {
    PyObject *module = PyModule_Create(&DEFINITION);
    if (module != NULL && PyModule_AddStringConstant(module, "sources", EXPANDED_TEXT(LOITER_SOURCES)) != 0) {
        Py_CLEAR(module);
    }
    return module;
}
