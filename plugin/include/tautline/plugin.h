// SPDX-License-Identifier: Apache-2.0
#ifndef TAUTLINE_PLUGIN_H
#define TAUTLINE_PLUGIN_H
/** The border of libtautline_plugin.so, in C: a host that was never compiled against Tautline loads the module, opens
it, and attaches muscles and other forces along paths to its SimTK::MultibodySystem.

    void* module = dlopen("libtautline_plugin.so", RTLD_NOW);
    tautline_plugin_open_function open = (tautline_plugin_open_function)dlsym(module, TAUTLINE_PLUGIN_OPEN);
    tautline_host host = TAUTLINE_HOST;
    const tautline_plugin* plugin;
    tautline_error error;
    if (open(&host, &plugin, &error) != TAUTLINE_OK) puts(error.message);

Everything else goes through the table `plugin`. Functions that can fail return a tautline_result and, if `error` is not
NULL, a message; what they would have written is then not written. No C++ exception crosses this border.

Units are SI and radians; vectors are in the ground frame. `system` is a SimTK::MultibodySystem*, `state` a
SimTK::State* of that system. "Stage" is the stage to which the state must have been realized: asked too early, a
function returns TAUTLINE_WRONG_STAGE. Names are those of the description; text is UTF-8 and ends with a zero.

Queries may be made by many threads at once, each with its own state; all else by one thread at a time. */
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Of everything in this file. Functions may be added at the end of the table without a new number. */
#define TAUTLINE_PLUGIN_ABI 1
/** The name of the only symbol that the module exports, a tautline_plugin_open_function. */
#define TAUTLINE_PLUGIN_OPEN "tautline_plugin_open"

typedef enum tautline_result {
    TAUTLINE_OK = 0,
    TAUTLINE_WRONG_ABI = 1,       /**< host and module were built for different versions of this file */
    TAUTLINE_WRONG_SIMBODY = 2,   /**< or for different versions or layouts of Simbody */
    TAUTLINE_BAD_DESCRIPTION = 3, /**< the text is malformed or asks for what is not there: see the line */
    TAUTLINE_UNKNOWN_NAME = 4,    /**< no such force, or index out of range */
    TAUTLINE_BAD_ARGUMENT = 5,    /**< a null pointer, or a value out of its limits, which the message names */
    TAUTLINE_WRONG_STAGE = 6,     /**< the state has not been realized far enough, or the topology is already */
    TAUTLINE_SYSTEM_GONE = 7,     /**< the system of the attachment has been destroyed */
    TAUTLINE_FAILED = 8           /**< anything else that Simbody or the C++ library reports */
} tautline_result;

#define TAUTLINE_MESSAGE_SIZE 2048
typedef struct tautline_error {
    int line; /**< in the description, counted from 1; 0 if the error is not in one */
    char message[TAUTLINE_MESSAGE_SIZE];
} tautline_error;

/** How the host was compiled. Simbody's State is laid out otherwise with NDEBUG than without, and its inline functions
handle it, so host, module and Simbody's library must agree. */
typedef struct tautline_host {
    int abi;
    int keeps_asserts;      /**< 1: compiled without NDEBUG */
    int simbody_version[3]; /**< of the headers: major, minor, patch; major 0: not told. The library is asked anyway */
} tautline_host;

#ifdef NDEBUG
#define TAUTLINE_HOST_KEEPS_ASSERTS 0
#else
#define TAUTLINE_HOST_KEEPS_ASSERTS 1
#endif
/** An initializer for the file that includes this one: compile it as the rest of the host. */
#define TAUTLINE_HOST                                       \
    {                                                       \
        TAUTLINE_PLUGIN_ABI, TAUTLINE_HOST_KEEPS_ASSERTS, { \
            0, 0, 0                                         \
        }                                                   \
    }

/** A name for a mobilized body, by which the description may call it. */
typedef struct tautline_body {
    const char* name;
    int mobilized_body; /**< SimTK::MobilizedBodyIndex; 0 is the ground */
} tautline_body;

/** Forces attached to a system. */
typedef struct tautline_attachment tautline_attachment;

typedef enum tautline_kind {
    TAUTLINE_MUSCLE = 0,             /**< has an excitation */
    TAUTLINE_SPRING = 1,             /**< PathSpring */
    TAUTLINE_PRESCRIBED_TENSION = 2, /**< TautlinePrescribedTension: its tension can be set */
    TAUTLINE_OTHER_FORCE = 3         /**< Ligament and others that follow from the path alone */
} tautline_kind;

/** What is known of a path. Only TAUTLINE_PATH_SOLVED is a shortest path; explain_status() says why others are not. */
typedef enum tautline_status {
    TAUTLINE_PATH_SOLVED = 0,
    TAUTLINE_PATH_NOT_MINIMUM = 1,
    TAUTLINE_PATH_LEFT_DOMAIN = 2,  /**< a contact lies beside its surface's domain */
    TAUTLINE_PATH_END_INSIDE = 3,   /**< a point lies in an obstacle, which is switched off */
    TAUTLINE_PATH_NOT_CONVERGED = 4 /**< the best path met */
} tautline_status;

/** An obstacle of a path. */
typedef struct tautline_contact {
    const char* name;   /**< of the wrap object; valid as long as the system */
    int mobilized_body; /**< that it is fixed to */
    int is_touched;
    double arc_length; /**< [m]; 0 while lifted */
    double clearance;  /**< signed distance to the straight segment that passes it [m]; NaN while touched */
    double P[3];       /**< where the path meets it; NaN while lifted */
    double Q[3];       /**< where the path leaves it; NaN while lifted */
} tautline_contact;

/** What a path's solves have cost, over all states and threads. */
typedef struct tautline_statistics {
    long num_solves;
    long num_cold_solves; /**< started anew instead of continued */
    long num_failures;    /**< ended as not converged */
    long num_iterations;
    long num_contact_events;
    long num_slips;
    double seconds;
} tautline_statistics;

/** Excitation [1] or tension [N] at a time, for a const SimTK::State* realized to Time (excitation) or Velocity
(tension). It is called by whoever realizes the state, from several threads if several do, and must not throw. */
typedef double (*tautline_function)(const void* state, double time, void* data);

/** The functions of the module; valid until it is unloaded. */
typedef struct tautline_plugin {
    int abi;
    size_t size;                 /**< of this table [bytes] */
    const char* version;         /**< of Tautline */
    const char* simbody_version; /**< that the module was built for */
    int keeps_asserts;           /**< that Simbody's layout has */

    /** Reads a description and adds its forces to the system, which needs a SimbodyMatterSubsystem with all its bodies
    and a GeneralForceSubsystem. If anything is refused, nothing has been added.

    A description is a TautlineForces document of the elements that model files have: a BodySet whose Body elements
    own wrap objects, and a ForceSet. Bodies are called by their indices ("0" or "ground", "1", ...) and by the names
    given here. A PathWrap without a range is bound to the segment of its path that is nearest to the wrap object in
    the system's default state.

    The system's topology must be realized anew, and earlier states of it are no longer of use.
    @param file_name   names the text in messages; NULL: "description"
    @param bodies      may be NULL
    @param attachment  to be released */
    tautline_result (*attach)(void* system, const char* description, const char* file_name, const tautline_body* bodies,
                              size_t num_bodies, tautline_attachment** attachment, tautline_error* error);
    /** Ends the handle, before or after the system is destroyed. The forces stay with the system, and the module stays
    loaded for as long as the system needs it, whatever the host unloads. Release before unloading. NULL is allowed. */
    void (*release)(tautline_attachment* attachment);

    /** What the user should know of how the description was understood: elements passed over, and why. */
    size_t (*get_num_notes)(const tautline_attachment* attachment);
    /** NULL if the index is out of range; valid as long as the attachment. */
    const char* (*get_note)(const tautline_attachment* attachment, size_t index);
    /** The forces: muscles, springs, then others, each in the order of the description. */
    size_t (*get_num_forces)(const tautline_attachment* attachment);
    /** NULL if the index is out of range; valid as long as the attachment. */
    const char* (*get_force_name)(const tautline_attachment* attachment, size_t index);
    tautline_result (*get_force_kind)(const tautline_attachment* attachment, const char* name, tautline_kind* kind,
                                      tautline_error* error);

    /** In [0, 1]. Stage: Model; invalidates Dynamics. */
    tautline_result (*set_excitation)(const tautline_attachment* attachment, void* state, const char* muscle,
                                      double excitation, tautline_error* error);
    /** In place of the state's own excitation; what it gives is limited to [minimum activation, 1]. Before the
    topology is realized. */
    tautline_result (*set_excitation_function)(tautline_attachment* attachment, const char* muscle,
                                               tautline_function excitation, void* data, tautline_error* error);
    /** Finite and not negative [N]. Stage: Topology; invalidates Dynamics. */
    tautline_result (*set_tension)(const tautline_attachment* attachment, void* state, const char* name, double tension,
                                   tautline_error* error);
    /** In place of the state's own tension; what it gives below zero counts as zero. Before the topology is realized.
     */
    tautline_result (*set_tension_function)(tautline_attachment* attachment, const char* name,
                                            tautline_function tension, void* data, tautline_error* error);
    /** Sets the fibers of all muscles to where they and their tendons pull alike at rest. Realizes the state to
    Position. */
    tautline_result (*equilibrate)(const tautline_attachment* attachment, void* state, tautline_error* error);

    /** [m]. Stage: Position */
    tautline_result (*get_length)(const tautline_attachment* attachment, const void* state, const char* name,
                                  double* length, tautline_error* error);
    /** [m/s], exact. Stage: Velocity */
    tautline_result (*get_rate)(const tautline_attachment* attachment, const void* state, const char* name,
                                double* rate, tautline_error* error);
    /** [N], never negative. Stage: Velocity */
    tautline_result (*get_tension)(const tautline_attachment* attachment, const void* state, const char* name,
                                   double* tension, tautline_error* error);
    /** Stage: Position */
    tautline_result (*calc_status)(const tautline_attachment* attachment, const void* state, const char* name,
                                   tautline_status* status, tautline_error* error);
    /** The status in a sentence: which condition is broken, at which obstacle and where. Stage: Position.
    @param text      room for `capacity` bytes; what does not fit is cut off. May be NULL if capacity is 0
    @param length    of the whole text, without the zero; may be NULL */
    tautline_result (*explain_status)(const tautline_attachment* attachment, const void* state, const char* name,
                                      char* text, size_t capacity, size_t* length, tautline_error* error);
    tautline_result (*get_num_obstacles)(const tautline_attachment* attachment, const char* name, size_t* number,
                                         tautline_error* error);
    /** Obstacle 0, 1, ... along the path. Stage: Position */
    tautline_result (*get_contact)(const tautline_attachment* attachment, const void* state, const char* name,
                                   size_t obstacle, tautline_contact* contact, tautline_error* error);
    /** Moment arm -dl/dq about one mobility whose speed u is q's derivative [m/rad or 1]. Stage: Position.
    @param mobilized_body   whose mobilizer it is
    @param mobility   SimTK::MobilizerUIndex: 0 for a pin's only one */
    tautline_result (*calc_moment_arm)(const tautline_attachment* attachment, const void* state, const char* name,
                                       int mobilized_body, int mobility, double* arm, tautline_error* error);
    /** Generalized forces of unit tension, one per mobility of the system: the moment arms. Stage: Position.
    @param num_arms   as many as the system has mobilities */
    tautline_result (*calc_moment_arms)(const tautline_attachment* attachment, const void* state, const char* name,
                                        double* arms, size_t num_arms, tautline_error* error);
    /** Points along the path, to draw it. Stage: Position.
    @param max_angle    by which the path turns between points of an arc [rad]
    @param points       x, y, z of at most `capacity` points; may be NULL if capacity is 0
    @param num_points   of all points */
    tautline_result (*calc_points)(const tautline_attachment* attachment, const void* state, const char* name,
                                   double max_angle, double* points, size_t capacity, size_t* num_points,
                                   tautline_error* error);
    tautline_result (*get_statistics)(const tautline_attachment* attachment, const char* name,
                                      tautline_statistics* statistics, tautline_error* error);
} tautline_plugin;

/** Gives the table, if host and module fit.
@param plugin   left alone if they do not
@param error    may be NULL */
typedef tautline_result (*tautline_plugin_open_function)(const tautline_host* host, const tautline_plugin** plugin,
                                                         tautline_error* error);

#ifdef __cplusplus
}
#endif
#endif
