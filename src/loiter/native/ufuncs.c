/* The extension module `loiter.compiled.loops`: NumPy ufuncs, made with NumPy's public C interface. */
#define PY_SSIZE_T_CLEAN
#include <Python.h>

#define NPY_NO_DEPRECATED_API NPY_2_0_API_VERSION
#define NPY_TARGET_VERSION NPY_2_0_API_VERSION
#include <numpy/ndarraytypes.h>
#include <numpy/ufuncobject.h>

#include "wind_loops.h"

enum { D = NPY_DOUBLE, B = NPY_BYTE };

static const char TYPES[][18] = {
    {D, D, D, D, D, D},
    {D, D, D, D, D, D},
    {D, D, D, D, D, D},
    {D, D, D, D, D, D, D, B, D, B, B, D},
    {D, D, D, D, D, D, D, D, D, D},
    {D, D, D, D, D, D, D, D, D, D, D, B, D, B, B, D, D},
    {D, D, D, D, D, D, D},
    {D, D, D, D, D, D, D, D, D, D, D},
};

static const struct {
    const char *name;
    int inputs, outputs;
    const char *signature;
} UFUNCS[] = {
    {"min_time", 5, 1, NULL},
    {"control", 5, 1, NULL},
    {"reduce", 4, 2, NULL},
    {"solve", 6, 6, "(),(),(),(),(),(n)->(),(),(n),(),(),()"},
    {"min_time_in_wind", 9, 1, NULL},
    {"solve_in_wind", 10, 7, "(),(),(),(),(),(),(),(),(),(n)->(),(),(n),(),(),(),()"},
    {"gradient", 4, 3, NULL},
    {"path_to_pose", 8, 3, NULL},
};

enum { COUNT = sizeof UFUNCS / sizeof *UFUNCS };

/* The loops for this processor; NumPy keeps pointers to them. */
static PyUFuncGenericFunction loops[COUNT];

#define USE_LOOPS(level)                                      \
    do {                                                      \
        loops[0] = (PyUFuncGenericFunction)loiter_min_time_##level; \
        loops[1] = (PyUFuncGenericFunction)loiter_control_##level;  \
        loops[2] = (PyUFuncGenericFunction)loiter_reduce_##level;   \
        loops[3] = (PyUFuncGenericFunction)loiter_solve_##level;    \
    } while (0)

/* Choose the loops for this processor; the name of the kind of processors. */
static const char *choose_loops(void) {
    loops[4] = (PyUFuncGenericFunction)loiter_min_time_in_wind;
    loops[5] = (PyUFuncGenericFunction)loiter_solve_in_wind;
    loops[6] = (PyUFuncGenericFunction)loiter_gradients;
    loops[7] = (PyUFuncGenericFunction)loiter_paths_to_poses;
#ifdef LOITER_X86_LEVELS
    __builtin_cpu_init();
    const int has_v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
    if (has_v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512cd")) {
        USE_LOOPS(v4);
        return "x86-64-v4";
    }
    if (has_v3) {
        USE_LOOPS(v3);
        return "x86-64-v3";
    }
    if (__builtin_cpu_supports("sse4.2")) {
        USE_LOOPS(v2);
        return "x86-64-v2";
    }
#endif
    USE_LOOPS(any);
    return "any";
}

static struct PyModuleDef DEFINITION = {
    PyModuleDef_HEAD_INIT, "loops", "The kernel as NumPy ufuncs.", -1, NULL, NULL, NULL, NULL, NULL,
};

static int add_ufunc(PyObject *module, int i) {
    static void *no_data[1];
    PyObject *ufunc = PyUFunc_FromFuncAndDataAndSignature(&loops[i], no_data, TYPES[i], 1, UFUNCS[i].inputs,
                                                          UFUNCS[i].outputs, PyUFunc_None, UFUNCS[i].name, NULL, 0,
                                                          UFUNCS[i].signature);
    const int failed = PyModule_AddObjectRef(module, UFUNCS[i].name, ufunc);
    Py_XDECREF(ufunc);
    return failed;
}

PyMODINIT_FUNC PyInit_loops(void) {
    import_array();
    import_umath();
    PyObject *module = PyModule_Create(&DEFINITION);
    if (module == NULL || PyModule_AddStringConstant(module, "processor", choose_loops()) != 0) {
        Py_XDECREF(module);
        return NULL;
    }
    for (int i = 0; i < COUNT; i++) {
        if (add_ufunc(module, i) != 0) {
            Py_DECREF(module);
            return NULL;
        }
    }
    return module;
}
