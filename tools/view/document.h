// document.h - The scene that the viewer edits, with undo.
#ifndef HAIR_TOOLS_VIEW_DOCUMENT_H
#define HAIR_TOOLS_VIEW_DOCUMENT_H

#include "tools/view/common.h"

#include <deque>
#include <memory>
#include <string>
#include <vector>

struct view_document {
    std::unique_ptr<hair_scene> scene; // edited by all controls
    std::string name; // name of the scene, for messages
    std::string file; // scene file, or ""
    std::unique_ptr<hair_scene> committed; // scene before the change that is under way
    std::deque<std::unique_ptr<hair_scene>> undo, redo;
    std::vector<hair_bullet_list> lists; // objects of all scenes that were open
};

// Begin with a scene. The document takes what the scene holds.
void view_document_open(view_document& document, const hair_scene& scene, const std::string& name,
                        const std::string& file);
void view_document_close(view_document& document);

// Make one step of undo of all changes since the last call. Call it while no control is held.
void view_document_commit(view_document& document);

// Take back the last step, or do it again. Return false if there is none.
bool view_document_undo(view_document& document);
bool view_document_redo(view_document& document);

#endif
